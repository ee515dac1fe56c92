#pragma once

#include "neural/loss/statistics.h"
#include "neural/network/network.h"

namespace gramloom::neural {

/// Positions of a picture whose feature maps are in memory at once. Statistics are sums over
/// positions, or sorts of few values for each, so a larger picture is looked at in bands of rows,
/// each with the rows around it that its maps depend on, and twice: for the statistics, and for
/// their gradient. A band has at least one row of the smallest maps.
inline constexpr std::int64_t most_positions_in_band = std::int64_t{1} << 18;

/// One of the bands that a picture is looked at in: feature maps of some of its rows.
struct PicturePart {
  std::vector<at::Tensor> strips;       // of the views: leaves of the graph of gradients
  std::vector<Rows> rows;               // which rows of the views these are
  std::vector<std::vector<Band>> maps;  // by layer and view
  std::vector<std::vector<Rows>> own;   // the rows of these that count
};

/// A picture as a network looks at it: its views (network.h), and their rows shared out among
/// parts. Statistics of the parts' own rows add up to those of the picture.
class PictureParts {
 public:
  /// wanted: the layers whose maps the parts have. shifts: see rows_for_moments(). The network and
  /// both lists must outlive this.
  PictureParts(const Network& network, const std::vector<std::size_t>& wanted,
               const at::Tensor& picture, Edges edges, const std::vector<int>& shifts,
               std::int64_t positions_in_band);

  std::int64_t count() const { return count_; }
  PicturePart part(std::int64_t i) const;

  /// Gradients of the views to add to.
  std::vector<at::Tensor> zeros() const;
  /// Adds the gradients of a part's strips to those of the views.
  void add(const PicturePart& part, const std::vector<at::Tensor>& of_strips,
           std::vector<at::Tensor>& of_views) const;
  /// The gradient of the picture from those of its views.
  at::Tensor of_picture(const std::vector<at::Tensor>& of_views) const;

 private:
  const Network& network_;
  const std::vector<std::size_t>& wanted_;
  Edges edges_;
  const std::vector<int>& shifts_;
  at::Tensor picture_;
  std::vector<at::Tensor> views_;         // of it, the first being itself
  std::vector<std::vector<Size>> sizes_;  // by view and layer
  std::int64_t count_ = 1;
};

}  // namespace gramloom::neural
