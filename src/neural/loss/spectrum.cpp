#include "neural/loss/spectrum.h"

#include <algorithm>
#include <vector>

#include "neural/loss/lags.h"
#include "neural/loss/loss_term.h"

namespace gramloom::neural {

namespace {

// Of a frequency: the root has no derivative at 0.
constexpr double least_power = 1e-8;

// Transforms need memory: of a large picture a channel at a time.
constexpr std::int64_t values_transformed_at_once = 1 << 20;

class SpectrumTerm : public PictureTerm {
 public:
  SpectrumTerm(const at::Tensor& exemplar, Size target) {
    const Size lags{std::max(1, std::min(static_cast<int>(exemplar.size(2)), target.width) / 2),
                    std::max(1, std::min(static_cast<int>(exemplar.size(1)), target.height) / 2)};
    const auto fade = [&](int count) {
      const at::Tensor t = at::arange(-count + 1, count, exemplar.options()) / count;
      return (t * 3.14159265358979).cos().add(1).div(2);
    };
    fade_ = on_torus((fade(lags.height).narrow(0, lags.height - 1, lags.height).view({-1, 1}) *
                      fade(lags.width).view({1, -1}))
                         .unsqueeze(0),
                     target)
                .squeeze(0);
    const at::Tensor torus = on_torus(autocorrelation(centred(exemplar), lags, Tile::none), target);
    const std::int64_t columns = target.width / 2 + 1;
    weight_ = at::full({columns}, 2.0, exemplar.options());
    weight_[0] = 1;
    if (target.width % 2 == 0) weight_[columns - 1] = 1;
    goal_ = (at::real(at::fft_rfft2(torus * fade_)).clamp_min(0) + least_power).sqrt();
    scale_ = inverse_of_sum(goal_.square() * weight_);
  }

  double add(const at::Tensor& picture, double weight, std::uint64_t,
             at::Tensor& gradient) const override {
    const std::vector<std::int64_t> shape{picture.size(1), picture.size(2)};
    const std::int64_t positions = shape[0] * shape[1];
    const std::int64_t at_once = std::max<std::int64_t>(1, values_transformed_at_once / positions);
    double sum = 0;
    for (std::int64_t c = 0; c < picture.size(0); c += at_once) {
      const std::int64_t count = std::min(at_once, picture.size(0) - c);
      // X is the transform; |X|² that of the correlation, which is faded; S is |X|² thereafter.
      const at::Tensor x = at::fft_rfft2(centred(picture.narrow(0, c, count)));
      const at::Tensor parts = at::view_as_real(x);
      const at::Tensor correlation =
          at::fft_irfft2(parts.square().sum(3), shape).div_(static_cast<double>(positions));
      const at::Tensor smooth = at::real(at::fft_rfft2(correlation.mul_(fade_)));
      const at::Tensor root = (smooth.clamp_min(0) + least_power).sqrt_();
      const at::Tensor error = root - goal_.narrow(0, c, count);
      sum += (error.square() * weight_).sum().item<double>() * scale_;
      // Back the same way, by the chain rule: ∂/∂S, ∂/∂correlation, ∂/∂|X|², ∂/∂x.
      const at::Tensor of_smooth = (error / root).mul_(smooth > 0);
      const at::Tensor of_correlation = at::fft_irfft2(of_smooth, shape).mul_(fade_);
      const at::Tensor of_power = at::real(at::fft_rfft2(of_correlation));
      parts.mul_(of_power.unsqueeze(3));
      gradient.narrow(0, c, count).add_(at::fft_irfft2(x, shape), weight * scale_ * 2);
    }
    return sum;
  }

 private:
  at::Tensor fade_;    // (height, width) of the lags on the torus of the result
  at::Tensor weight_;  // of each column of a real transform: how many frequencies it stands for
  at::Tensor goal_;    // (channels, height, width / 2 + 1)
  double scale_ = 0;
};

}  // namespace

std::unique_ptr<PictureTerm> make_term(const SpectrumParams&, const LossInput& input) {
  return std::make_unique<SpectrumTerm>(input.exemplar, input.target.size);
}

}  // namespace gramloom::neural
