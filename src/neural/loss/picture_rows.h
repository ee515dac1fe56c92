#pragma once

#include <functional>

#include "neural/network/network.h"
#include "neural/network/work.h"

namespace gramloom::neural {

/// Some rows of a picture as a network sees them: those of its scales, and their feature maps.
struct SeenRows {
  std::vector<at::Tensor> inputs;           // of the scales: leaves of the graph of gradients
  std::vector<Rows> behind;                 // which rows of the scales these are
  std::vector<std::vector<HeldRows>> maps;  // by layer and scale
  std::vector<std::vector<Rows>> own;       // the rows of these that count
};

/// The rows of a layer's maps at each scale that are needed where rows `own` count; `sizes` are
/// those of the whole maps.
using RowsNeeded =
    std::function<std::vector<Rows>(const std::vector<Size>& sizes, const std::vector<Rows>& own)>;

/// A picture as a network looks at it: its scales (network.h), whose rows are shared out, so that
/// each share is seen alone. Statistics of the shares' own rows add up to those of the picture.
class PictureRows {
 public:
  /// wanted: the layers whose maps are seen. The network and `wanted` must outlive this.
  PictureRows(const Network& network, const std::vector<std::size_t>& wanted,
              const at::Tensor& picture, Edges edges, RowsNeeded needed,
              std::int64_t positions_at_once);

  std::int64_t shares() const { return shares_; }
  SeenRows see(std::int64_t share) const;

  /// Gradients of the scales to add to.
  std::vector<at::Tensor> zeros() const;
  /// Adds the gradients of the inputs of some rows to those of the scales.
  void add(const SeenRows& rows, const std::vector<at::Tensor>& of_inputs,
           std::vector<at::Tensor>& of_scales) const;
  /// The gradient of the picture from those of its scales.
  at::Tensor of_picture(const std::vector<at::Tensor>& of_scales) const;

 private:
  const Network& network_;
  const std::vector<std::size_t>& wanted_;
  Edges edges_;
  RowsNeeded needed_;
  at::Tensor picture_;
  std::vector<at::Tensor> scales_;        // of it, the first being itself
  std::vector<std::vector<Size>> sizes_;  // by scale and layer
  std::int64_t shares_ = 1;
};

}  // namespace gramloom::neural
