#pragma once

#include <vector>

#include "classic/exemplar_quota.h"
#include "classic/pixel.h"
#include "classic/pixel_canvas.h"
#include "core/request.h"

namespace gramloom::pixel {

/// Exemplars as one picture (signal/united.h), and a target whose guide belongs to that.
struct Task {
  const Exemplar& exemplar;
  Size size;
  Tile tile;
  const Image& known;
  const Image& mask;
  const Image& guide;
  const Image& guide_weight;
  int shares = 0;  // the guide's last channels are exemplars' shares: constant within each
  ExemplarQuota quota = {};
  bool same_picture = false;  // known pixels are the exemplar's at the same place
};

/// What a task asks of a canvas at one level, beyond looking like the exemplar.
struct Aim {
  Image colours;                        // of known pixels, as comparisons see them
  std::vector<std::uint8_t> made = {};  // of each pixel: 1 is made, 0 is known; empty: all are made
  Image guide;                          // as Level::guide; empty: none
  Image weight;                         // of the guide, squared: of the canvas's size or 1×1
  Size size;

  bool is_made(std::size_t index) const { return made.empty() || made[index] != 0; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }
  /// Of pixel (x, y), when it comes from this sample of the level: weight² · |difference of
  /// guides|², half of it the pixel's own and half that of means about it, so that what lies near
  /// the border of a label comes from near one. The means count by a weight of at most 1: however
  /// hard a label is, near its border there is to be texture.
  float guide_error(const Level& level, int sample, int x, int y) const;
};

/// level_count() for a task. Where there are known pixels no more levels than bring the middle of
/// the largest hole near to them, as far as the exemplar is not too large to be searched in full:
/// coarser ones would know less of what is to be continued.
int level_count(int asked, const Task& task);

/// Tells the levels which samples may be used, and their guides; one aim a level. Guides are
/// blurred and halved as colours are, but shares, which end where an exemplar ends; coarse pixels
/// are known where all that they stand for are. radius: of neighbourhoods.
std::vector<Aim> direct(std::vector<Level>& levels, const Task& task, int radius);

/// errors of all samples += weight · guide_error at pixel (x, y) where there is a guide and the
/// pixel is made; those of samples that may not be used become out of reach.
void add_direction(const Level& level, const Aim& aim, int x, int y, float weight,
                   std::vector<float>& errors);

/// Which pixels lie within `radius` of one that is made, and are known themselves.
std::vector<std::uint8_t> rim(const Aim& aim, Tile tile, int radius);

}  // namespace gramloom::pixel
