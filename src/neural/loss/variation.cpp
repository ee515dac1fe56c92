#include "neural/loss/variation.h"

#include "neural/loss/add_gradient.h"
#include "neural/loss/loss_term.h"

namespace gramloom::neural {

namespace {

// Of each channel, from differences along x and y; on an axis that does not wrap, the last one is
// 0.
at::Tensor total_variation(const at::Tensor& planes, Tile wraps) {
  const auto difference = [&](std::int64_t axis, bool wrap) {
    const at::Tensor next = at::roll(planes, -1, axis);
    if (wrap) return next - planes;
    const std::int64_t side = planes.size(axis);
    return at::constant_pad_nd((next - planes).narrow(axis, 0, side - 1),
                               axis == 1 ? at::IntArrayRef({0, 0, 0, 1}) : at::IntArrayRef({0, 1}));
  };
  const at::Tensor dx = difference(2, tiles_x(wraps)), dy = difference(1, tiles_y(wraps));
  return (dx * dx + dy * dy + 1e-8).sqrt().mean({1, 2});
}

class VariationTerm : public PictureTerm {
 public:
  VariationTerm(const at::Tensor& exemplar, Tile wraps) : wraps_(wraps) {
    const at::Tensor variation = total_variation(exemplar, Tile::none);
    inverse_ = at::where(variation > 1e-3, 1 / variation, at::zeros_like(variation));
  }

  double add(const at::Tensor& picture, double weight, std::uint64_t,
             at::Tensor& gradient) const override {
    return add_gradient(picture, weight, gradient, [&](const at::Tensor& x) {
      const at::Tensor ratio = total_variation(x, wraps_) * inverse_;
      return at::where(inverse_ > 0, (ratio - 1).square(), at::zeros_like(ratio)).mean();
    });
  }

 private:
  Tile wraps_;
  at::Tensor inverse_;  // 1 / V̂ of each channel; 0 where the exemplar is flat
};

}  // namespace

std::unique_ptr<PictureTerm> make_term(const VariationParams&, const LossInput& input) {
  return std::make_unique<VariationTerm>(input.exemplar, input.target.tile);
}

}  // namespace gramloom::neural
