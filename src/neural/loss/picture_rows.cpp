#include "neural/loss/picture_rows.h"

#include <c10/core/GradMode.h>
#include <torch/csrc/autograd/autograd.h>

#include <algorithm>

namespace gramloom::neural {

PictureRows::PictureRows(const Network& network, const std::vector<std::size_t>& wanted,
                         const at::Tensor& picture, Edges edges, RowsNeeded needed,
                         std::int64_t positions_at_once)
    : network_(network),
      wanted_(wanted),
      edges_(edges),
      needed_(std::move(needed)),
      picture_(picture.detach()) {
  if (c10::GradMode::is_enabled()) picture_.requires_grad_(true);
  scales_ = network.scales(picture_, edges);
  for (const auto& scale : scales_) sizes_.push_back(network.sizes(size_of(scale), edges));
  const std::int64_t positions = picture.size(1) * picture.size(2);
  shares_ = (positions + positions_at_once - 1) / positions_at_once;
  for (const auto& sizes : sizes_)  // each share has a row of each layer
    for (const std::size_t layer : wanted)
      shares_ = std::min<std::int64_t>(shares_, sizes[layer].height);
}

SeenRows PictureRows::see(std::int64_t share) const {
  SeenRows seen;
  std::vector<std::vector<Rows>> needed;  // by layer and scale
  for (const std::size_t layer : wanted_) {
    std::vector<Size> sizes;
    std::vector<Rows> own;
    for (const auto& of_scale : sizes_) {
      sizes.push_back(of_scale[layer]);
      own.push_back(share_of(of_scale[layer].height, share, shares_));
    }
    needed.push_back(needed_(sizes, own));
    seen.own.push_back(std::move(own));
  }
  seen.maps.resize(wanted_.size());
  for (std::size_t k = 0; k < scales_.size(); ++k) {
    std::vector<Rows> rows;
    for (const auto& of_layer : needed) rows.push_back(of_layer[k]);
    const HeldRows scale = all_rows(scales_[k].detach());
    const Rows behind = network_.rows_of_scale(size_of(scale.data), edges_, wanted_, rows);
    const at::Tensor input = take_rows(scale, behind, edges_.y).detach().requires_grad_(true);
    const auto maps = network_.maps_of_rows(k, {input, scale.channels, behind, scale.height},
                                            edges_, wanted_, rows);
    for (std::size_t l = 0; l < maps.size(); ++l) seen.maps[l].push_back(maps[l]);
    seen.inputs.push_back(input);
    seen.behind.push_back(behind);
  }
  return seen;
}

std::vector<at::Tensor> PictureRows::zeros() const {
  std::vector<at::Tensor> result;
  for (const auto& scale : scales_) result.push_back(at::zeros_like(scale));
  return result;
}

void PictureRows::add(const SeenRows& rows, const std::vector<at::Tensor>& of_inputs,
                      std::vector<at::Tensor>& of_scales) const {
  for (std::size_t k = 0; k < scales_.size(); ++k) {
    std::vector<std::int64_t> places;
    for (std::int64_t row = rows.behind[k].begin; row < rows.behind[k].end; ++row)
      places.push_back(source_of(row, scales_[k].size(1), Padding::circular));
    of_scales[k].index_add_(1, at::tensor(places, at::kLong), of_inputs[k]);
  }
}

at::Tensor PictureRows::of_picture(const std::vector<at::Tensor>& of_scales) const {
  if (of_scales.size() == 1) return of_scales[0];
  return of_scales[0] + torch::autograd::grad({scales_.begin() + 1, scales_.end()}, {picture_},
                                              {of_scales.begin() + 1, of_scales.end()})[0];
}

}  // namespace gramloom::neural
