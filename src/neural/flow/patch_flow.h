#pragma once

#include <ATen/ATen.h>

#include <memory>

#include "core/image.h"
#include "core/random.h"
#include "neural/flow/params.h"

namespace gramloom::neural {

/// How far a layout is: enough to go on to the same bytes.
struct FlowState {
  std::int64_t octave = 0, step = 0;  // octave 0 is the coarsest; steps done on it
  at::Tensor picture;                 // (channels, height, width)
  at::Tensor prices;                  // (height, width) of the exemplar's patches
};

/// Patch flow matching, in closed form and without training (Chatillon, Rabin, Tschumperlé 2025,
/// "NIFTY"; Qiu et al. 2026, "Efficient-SID"): the straight flow from noise z to the exemplar's
/// patches x, y_t = t x + (1 − t) z, follows the mean of x given y_t, which is a mean of exemplar
/// patches weighted by exp(−|y − t x|² / 2 (1 − t)²): here of the nearest few. Overlapping patches
/// vote, and y moves towards the vote, coarse to fine, each octave beginning with some noise.
///
/// Ours: a price on each exemplar patch, raised while it is used more than others and lowered while
/// less, so that all are used alike (semi-discrete optimal transport); the deviations of Laplacian
/// bands are the exemplar's (means of patches are blurred); the candidates are drawn anew each step,
/// so that the picture is no copy.
///
/// The picture wraps on both axes. The same bytes for any number of threads.
class PatchFlow {
 public:
  /// exemplar: (channels, height, width), of mean square about 1. Throws Error when it is too small.
  PatchFlow(const FlowParams& params, const at::Tensor& exemplar, Size size, Random random);
  ~PatchFlow();

  std::int64_t steps() const;
  std::int64_t steps_done(const FlowState& state) const;
  bool done(const FlowState& state) const;
  void step(FlowState& state);

 private:
  struct Octave;
  Octave& octave(std::int64_t index);

  const FlowParams& params_;
  at::Tensor exemplar_;
  Size size_;
  Random random_;
  std::unique_ptr<Octave> octave_;
};

}  // namespace gramloom::neural
