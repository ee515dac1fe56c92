#pragma once

#include <functional>

#include "neural/network/network.h"
#include "neural/network/work.h"
#include "neural/shared_rows.h"

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

/// A picture as a network looks at it: its scales (network.h), whose rows are shared out, first
/// among processes and then so that each share is seen alone. Statistics of the shares' own rows
/// add up to those of the picture.
class PictureRows {
 public:
  /// picture: the rows of it that are this process' own. wanted: the layers whose maps are seen.
  /// The network and `wanted` must outlive this. Throws Error where there are more processes than
  /// rows of a layer.
  PictureRows(const Network& network, const std::vector<std::size_t>& wanted,
              const HeldRows& picture, Edges edges, RowsNeeded needed,
              std::int64_t positions_at_once, const Group& group = one_process());

  /// Of this process.
  std::int64_t shares() const { return shares_; }
  SeenRows see(std::int64_t share) const;

  /// Gradients of the scales, as far as they are held, to add to.
  std::vector<at::Tensor> zeros() const;
  /// Adds the gradients of the inputs of some rows to those of the scales.
  void add(const SeenRows& rows, const std::vector<at::Tensor>& of_inputs,
           std::vector<at::Tensor>& of_scales) const;
  /// The gradient of the own rows of the picture from those of its scales.
  at::Tensor of_picture(const std::vector<at::Tensor>& of_scales) const;

 private:
  // What a share sees.
  struct Sight {
    std::vector<std::vector<Rows>> own, needed;  // of the maps, by layer and scale
    std::vector<Rows> behind;                    // of the scales
  };
  Sight sight_of(std::int64_t share) const;

  // A scale: the rows that this process looks at, its own and those around them.
  struct Scale {
    HeldRows held;
    RowExchange exchange;
  };
  // From a scale to the next smaller one.
  struct Step {
    at::Tensor from, to;  // rows that are taken, own rows
    RowExchange exchange;
  };
  Step step_to(std::size_t scale, const HeldRows& finer) const;

  const Network& network_;
  const std::vector<std::size_t>& wanted_;
  Edges edges_;
  RowsNeeded needed_;
  const Group& group_;
  std::vector<Size> scale_sizes_;
  std::vector<std::vector<Size>> sizes_;  // by scale and layer
  std::vector<Scale> scales_;             // of the picture, the first being itself
  std::vector<Step> steps_;               // one less
  std::int64_t shares_ = 1;
};

}  // namespace gramloom::neural
