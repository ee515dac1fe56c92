#include "neural/loss/picture_parts.h"

#include <torch/csrc/autograd/autograd.h>

#include <algorithm>

namespace gramloom::neural {

PictureParts::PictureParts(const Network& network, const std::vector<std::size_t>& wanted,
                           const at::Tensor& picture, Edges edges, const std::vector<int>& shifts,
                           std::int64_t positions_in_band)
    : network_(network),
      wanted_(wanted),
      edges_(edges),
      shifts_(shifts),
      picture_(picture.detach()) {
  if (c10::GradMode::is_enabled()) picture_.requires_grad_(true);
  views_ = network.views(picture_, edges);
  for (const auto& view : views_) sizes_.push_back(network.sizes(size_of(view), edges));
  const std::int64_t positions = picture.size(1) * picture.size(2);
  count_ = (positions + positions_in_band - 1) / positions_in_band;
  for (const auto& sizes : sizes_)  // each part has a row of each layer
    for (const std::size_t layer : wanted)
      count_ = std::min<std::int64_t>(count_, sizes[layer].height);
}

PicturePart PictureParts::part(std::int64_t i) const {
  PicturePart part;
  std::vector<std::vector<Rows>> needed;  // by layer and view
  for (const std::size_t layer : wanted_) {
    std::vector<Size> sizes;
    std::vector<Rows> own;
    for (const auto& of_view : sizes_) {
      sizes.push_back(of_view[layer]);
      own.push_back(part_of(of_view[layer].height, i, count_));
    }
    needed.push_back(rows_for_moments(sizes, own, wrapped_axes(edges_), shifts_));
    part.own.push_back(std::move(own));
  }
  part.maps.resize(wanted_.size());
  for (std::size_t k = 0; k < views_.size(); ++k) {
    std::vector<Rows> rows;
    for (const auto& of_layer : needed) rows.push_back(of_layer[k]);
    const Band view = whole_band(views_[k].detach());
    const Rows behind = network_.rows_of_view(size_of(view.data), edges_, wanted_, rows);
    const at::Tensor strip = take_rows(view, behind, edges_.y).detach().requires_grad_(true);
    const auto bands =
        network_.bands(k, {strip, view.channels, behind, view.height}, edges_, wanted_, rows);
    for (std::size_t l = 0; l < bands.size(); ++l) part.maps[l].push_back(bands[l]);
    part.strips.push_back(strip);
    part.rows.push_back(behind);
  }
  return part;
}

std::vector<at::Tensor> PictureParts::zeros() const {
  std::vector<at::Tensor> result;
  for (const auto& view : views_) result.push_back(at::zeros_like(view));
  return result;
}

void PictureParts::add(const PicturePart& part, const std::vector<at::Tensor>& of_strips,
                       std::vector<at::Tensor>& of_views) const {
  for (std::size_t k = 0; k < views_.size(); ++k) {
    std::vector<std::int64_t> rows;
    for (std::int64_t row = part.rows[k].begin; row < part.rows[k].end; ++row)
      rows.push_back(source_of(row, views_[k].size(1), Padding::circular));
    of_views[k].index_add_(1, at::tensor(rows, at::kLong), of_strips[k]);
  }
}

at::Tensor PictureParts::of_picture(const std::vector<at::Tensor>& of_views) const {
  if (of_views.size() == 1) return of_views[0];
  return of_views[0] + torch::autograd::grad({views_.begin() + 1, views_.end()}, {picture_},
                                             {of_views.begin() + 1, of_views.end()})[0];
}

}  // namespace gramloom::neural
