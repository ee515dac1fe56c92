#pragma once

#include <ATen/ATen.h>

#include <memory>

#include "core/random.h"
#include "core/request.h"
#include "neural/flow/params.h"
#include "neural/flow/periodic_part.h"
#include "neural/guidance.h"

namespace gramloom::neural {

/// How far a layout is: enough to go on to the same bytes.
struct FlowState {
  std::int64_t step = 0;  // steps done on this octave
  at::Tensor picture;     // (channels, height, width)
  at::Tensor goal;        // what the last step moved it towards: free of noise
  at::Tensor prices;      // (height, width) of the exemplar's patches
  at::Tensor sources;     // (rows, columns, 2) of the last step's patches: x, y of the
                          // exemplar's nearest, less the patch's own; undefined: none
};

/// Patch flow matching, in closed form and without training (Chatillon, Rabin, Tschumperlé 2025,
/// "NIFTY"; Qiu et al. 2026, "Efficient-SID"): the straight flow from noise z to the exemplar's
/// patches x, y_t = t x + (1 − t) z, follows the mean of x given y_t, which is a mean of exemplar
/// patches weighted by exp(−|y − t x|² / 2 (1 − t)²): here of the nearest few. Overlapping patches
/// vote, and y moves towards the vote, coarse to fine, each octave beginning with some noise.
///
/// Ours: a price on each exemplar patch, raised while it is used more than others and lowered while
/// less, so that all are used alike (semi-discrete optimal transport); the deviations of Laplacian
/// bands are the exemplar's (means of patches are blurred); the candidates are drawn anew each
/// step, so that the picture is no copy.
///
/// The picture wraps on both axes. The same bytes for any number of threads.
///
/// With guidance (guidance.h): patches are of usable pixels alone, and there are no courses of
/// several exemplars or with what directs the result. A guide's values are further coordinates of
/// the search (guided_patches.h), a pixel votes the less the less its guide is like that of its
/// place, prices balance the use of patches of like guides, and bands are matched where guides are
/// alike. Of a fill only patches with a pixel that is made are looked for, among thousands of the
/// exemplar's; those near known pixels count more in a vote; after each step the known pixels are,
/// without noise, what they are at that time of the flow (octave_guidance.h).
class PatchFlow {
 public:
  /// exemplar: (channels, height, width). Throws Error when it is too small.
  PatchFlow(const FlowParams& params, const at::Tensor& exemplar, const Target& target,
            Random random, const Guidance* guidance = nullptr);
  ~PatchFlow();

  /// One step on an octave: octave i is 2⁻ⁱ of the whole size. On the first step of the coarsest
  /// one there is no picture yet, or, of a fill, that of first_fill(); on the first of another it
  /// is the coarser one's.
  void step(FlowState& state, int octave, bool coarsest);
  /// At the end: the finest octave's picture in the target's size: whole courses are cropped, or
  /// stretched where it tiles.
  at::Tensor fitted(at::Tensor picture);

 private:
  struct Octave;
  Octave& octave(int index, bool coarsest);

  FlowParams params_;
  at::Tensor exemplar_;  // of mean square 1
  double scale_;         // of the flow's pictures
  Target target_;
  PeriodicAxis x_, y_;
  Size size_;  // of the layout: whole courses
  Random random_;
  const Guidance* guidance_;  // of the finest octave; none: the exemplar as a whole
  std::unique_ptr<Octave> octave_;
};

}  // namespace gramloom::neural
