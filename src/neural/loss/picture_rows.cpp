#include "neural/loss/picture_rows.h"

#include <c10/core/GradMode.h>
#include <torch/csrc/autograd/autograd.h>

#include <algorithm>

#include "core/error.h"
#include "neural/resample.h"

namespace gramloom::neural {

PictureRows::PictureRows(const Network& network, const std::vector<std::size_t>& wanted,
                         const HeldRows& picture, Edges edges, RowsNeeded needed,
                         std::int64_t positions_at_once, const Group& group)
    : network_(network),
      wanted_(wanted),
      edges_(edges),
      needed_(std::move(needed)),
      group_(group),
      scale_sizes_(network.scale_sizes(picture.size())) {
  for (const Size size : scale_sizes_) sizes_.push_back(network.sizes(size, edges));
  const std::int64_t own_height = (picture.height + group.size() - 1) / group.size();
  const std::int64_t positions = own_height * picture.data.size(2);
  shares_ = (positions + positions_at_once - 1) / positions_at_once;
  for (const auto& sizes : sizes_)  // each share has a row of each layer
    for (const std::size_t layer : wanted)
      shares_ = std::min<std::int64_t>(shares_, sizes[layer].height / group.size());
  if (shares_ < 1)
    throw Error("a picture of {}×{} is too small for {} processes: a layer has fewer rows",
                picture.size().width, picture.height, group.size());

  HeldRows own = picture;
  own.data = own.data.detach();
  for (std::size_t k = 0; k < scale_sizes_.size(); ++k) {
    if (k > 0) {
      steps_.push_back(step_to(k, own));
      own = held_by(group, steps_.back().to, scale_sizes_[k].height);
    }
    Rows behind = own.rows;
    for (std::int64_t share = 0; share < shares_ && !group.alone(); ++share)
      behind = hull(behind, sight_of(share).behind[k]);
    const RowExchange exchange(group, own.height, rows_behind(behind, own.height, edges.y));
    HeldRows held = exchange.take(own);
    held.data = held.data.detach();
    scales_.push_back({held, exchange});
  }
}

PictureRows::Step PictureRows::step_to(std::size_t scale, const HeldRows& finer) const {
  const Size size = scale_sizes_[scale];
  const Tile wraps = wrapped_axes(edges_);
  const Rows own = own_rows(group_, size.height);
  const RowExchange exchange(group_, finer.height,
                             rows_to_resample(own, finer.height, size.height, wraps));
  HeldRows taken = exchange.take(finer);
  taken.data = taken.data.detach();
  if (c10::GradMode::is_enabled()) taken.data.requires_grad_(true);
  return {taken.data, resample(taken, size, own, wraps).data, exchange};
}

PictureRows::Sight PictureRows::sight_of(std::int64_t share) const {
  Sight sight;
  for (const std::size_t layer : wanted_) {
    std::vector<Size> sizes;
    std::vector<Rows> own;
    for (const auto& of_scale : sizes_) {
      sizes.push_back(of_scale[layer]);
      own.push_back(share_of(of_scale[layer].height, group_.rank() * shares_ + share,
                             group_.size() * shares_));
    }
    sight.needed.push_back(needed_(sizes, own));
    sight.own.push_back(std::move(own));
  }
  for (std::size_t k = 0; k < scale_sizes_.size(); ++k) {
    std::vector<Rows> rows;
    for (const auto& of_layer : sight.needed) rows.push_back(of_layer[k]);
    sight.behind.push_back(network_.rows_of_scale(scale_sizes_[k], edges_, wanted_, rows));
  }
  return sight;
}

SeenRows PictureRows::see(std::int64_t share) const {
  Sight sight = sight_of(share);
  SeenRows seen;
  seen.maps.resize(wanted_.size());
  for (std::size_t k = 0; k < scales_.size(); ++k) {
    std::vector<Rows> rows;
    for (const auto& of_layer : sight.needed) rows.push_back(of_layer[k]);
    const HeldRows& scale = scales_[k].held;
    const Rows behind = sight.behind[k];
    const at::Tensor input = take_rows(scale, behind, edges_.y).detach().requires_grad_(true);
    const auto maps = network_.maps_of_rows(k, {input, scale.channels, behind, scale.height},
                                            edges_, wanted_, rows);
    for (std::size_t l = 0; l < maps.size(); ++l) seen.maps[l].push_back(maps[l]);
    seen.inputs.push_back(input);
  }
  seen.behind = std::move(sight.behind);
  seen.own = std::move(sight.own);
  return seen;
}

std::vector<at::Tensor> PictureRows::zeros() const {
  std::vector<at::Tensor> result;
  for (const Scale& scale : scales_) result.push_back(at::zeros_like(scale.held.data));
  return result;
}

void PictureRows::add(const SeenRows& rows, const std::vector<at::Tensor>& of_inputs,
                      std::vector<at::Tensor>& of_scales) const {
  for (std::size_t k = 0; k < scales_.size(); ++k) {
    const HeldRows& scale = scales_[k].held;
    std::vector<std::int64_t> places;
    for (std::int64_t row = rows.behind[k].begin; row < rows.behind[k].end; ++row)
      places.push_back(held_copy(row, scale.rows, scale.height));
    of_scales[k].index_add_(1, at::tensor(places, at::kLong), of_inputs[k]);
  }
}

at::Tensor PictureRows::of_picture(const std::vector<at::Tensor>& of_scales) const {
  at::Tensor result = scales_.back().exchange.give_back(of_scales.back());
  for (std::size_t k = steps_.size(); k-- > 0;) {
    const Step& step = steps_[k];
    const at::Tensor of_taken = torch::autograd::grad({step.to}, {step.from}, {result})[0];
    result = scales_[k].exchange.give_back(of_scales[k]) + step.exchange.give_back(of_taken);
  }
  return result;
}

}  // namespace gramloom::neural
