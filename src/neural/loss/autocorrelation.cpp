#include "neural/loss/autocorrelation.h"

#include <algorithm>

#include "neural/loss/add_gradient.h"
#include "neural/loss/lags.h"
#include "neural/loss/loss_term.h"

namespace gramloom::neural {

namespace {

at::Tensor without_lag_0(at::Tensor autocorrelation) {
  autocorrelation.select(1, 0).select(1, autocorrelation.size(2) / 2).zero_();
  return autocorrelation;
}

class AutocorrelationTerm : public PictureTerm {
 public:
  AutocorrelationTerm(const at::Tensor& exemplar, Size target, Tile wraps)
      : lags_{std::max(1, std::min(static_cast<int>(exemplar.size(2)) / 4, target.width / 2)),
              std::max(1, std::min(static_cast<int>(exemplar.size(1)) / 4, target.height / 2))},
        wraps_(wraps),
        goal_(without_lag_0(autocorrelation(centred(exemplar), lags_, Tile::none))),
        scale_(inverse_of_sum(goal_.square())) {}

  double add(const at::Tensor& picture, double weight, std::uint64_t,
             at::Tensor& gradient) const override {
    return add_gradient(picture, weight, gradient, [&](const at::Tensor& x) {
      const at::Tensor own = without_lag_0(autocorrelation(centred(x), lags_, wraps_));
      return (own - goal_).square().sum() * scale_;
    });
  }

 private:
  Size lags_;
  Tile wraps_;
  at::Tensor goal_;
  double scale_;
};

}  // namespace

std::unique_ptr<PictureTerm> make_term(const AutocorrelationParams&, const LossInput& input) {
  return std::make_unique<AutocorrelationTerm>(input.exemplar, input.target.size,
                                               input.target.tile);
}

}  // namespace gramloom::neural
