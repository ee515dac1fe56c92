#pragma once

#include <ATen/ATen.h>

#include <string_view>
#include <variant>

#include "core/image.h"
#include "neural/loss/sliced.h"

namespace gramloom::neural {

/// The mean product of each channel with itself shifted by (dy, dx), for dy in [0, lags.height) and
/// dx in (−lags.width, lags.width): (channels, lags.height, 2 lags.width − 1), dx = 0 in the
/// middle. On an axis that wraps all positions count, on others those whose partner is inside.
/// Differentiable.
at::Tensor autocorrelation(const at::Tensor& planes, Size lags, Tile wraps);

/// Σ (A − Â)² / Σ Â² over the lags up to a quarter of the exemplar's sides (and less than half the
/// result's) but 0, of centred pictures: what repeats at a distance (Sendik, Cohen-Or 2017 take
/// that of deep features).
class AutocorrelationTerm {
 public:
  static constexpr std::string_view name = "autocorrelation";
  AutocorrelationTerm(const at::Tensor& exemplar, Size target, Tile wraps);
  double add(const at::Tensor& picture, double weight, std::uint64_t step,
             at::Tensor& gradient) const;

 private:
  Size lags_;
  Tile wraps_;
  at::Tensor goal_;
  double scale_ = 0;
};

/// Σ (|X| − |X̂|)² / Σ |X̂|² over all frequencies of centred pictures: the Fourier modulus (Liu,
/// Gousseau, Xia 2016, "Texture synthesis through convolutional neural networks and spectrum
/// constraints", equation 7). Departure: |X|² is the transform of the autocorrelation up to half
/// the exemplar's sides, faded out towards there: it serves results of any size, does not see where
/// the exemplar ends (the result is taken as if it tiled), and does not ask for the exemplar's very
/// frequencies, which another size may not have.
class SpectrumTerm {
 public:
  static constexpr std::string_view name = "spectrum";
  SpectrumTerm(const at::Tensor& exemplar, Size target);
  double add(const at::Tensor& picture, double weight, std::uint64_t step,
             at::Tensor& gradient) const;

 private:
  at::Tensor modulus(const at::Tensor& correlation) const;

  at::Tensor fade_;    // (height, width) of the lags on the torus of the result
  at::Tensor weight_;  // of each column of a real transform: how many frequencies it stands for
  at::Tensor goal_;    // (channels, height, width / 2 + 1)
  double scale_ = 0;
};

/// The mean over channels of (V/V̂ − 1)², with V the total variation, the mean length of the
/// gradient: less grain than the exemplar has counts as much as more (Mahendran, Vedaldi 2015 have
/// V itself, which smooths).
class VariationTerm {
 public:
  static constexpr std::string_view name = "variation";
  VariationTerm(const at::Tensor& exemplar, Tile wraps);
  double add(const at::Tensor& picture, double weight, std::uint64_t step,
             at::Tensor& gradient) const;

 private:
  Tile wraps_;
  at::Tensor inverse_;  // 1 / V̂ of each channel; 0 where the exemplar is flat
};

/// A term of the loss that looks at the picture itself. add() returns its value, unweighted, and
/// adds `weight` times its gradient; `step` matters to those that draw random numbers.
using PictureTerm = std::variant<SlicedTerm, SpectrumTerm, AutocorrelationTerm, VariationTerm>;

}  // namespace gramloom::neural
