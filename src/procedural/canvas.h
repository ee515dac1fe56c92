#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"
#include "procedural/fractal.h"
#include "procedural/pack.h"

namespace gramloom {

/// The plane on which a texture is evaluated, in features: the picture is `width` × `height`
/// features large. Textures get their lattices here, because where the picture tiles the
/// frequencies are rounded so that a whole number of lattice steps fits.
struct Canvas {
  Size size;
  Tile tile = Tile::none;
  int samples = 1;  // along x and along y of a pixel
  float width = 1, height = 1;
  float step_x = 1, step_y = 1;  // features a pixel
  // The cutting plane: origin + x·right + y·down, in the order x, y, z, w.
  std::array<float, 4> origin{0, 0, 0, 0};
  std::array<float, 4> right{1, 0, 0, 0};
  std::array<float, 4> down{0, 1, 0, 0};
  int loop_axis = -1;     // the axis along which the sequence comes back to its start
  float loop_length = 0;  // after so many features
  std::span<const std::array<float, 3>> points;  // if any: a pixel is each of these, not the plane
  std::array<float, 3> light{0, 0, 1};           // unit vector towards the light; y points down
  Random random{0};
  const Control* control = nullptr;

  /// How many of something fit along an axis: `per_feature` of them a feature, rounded to a whole
  /// number (a multiple of `multiple`) where the picture tiles along it.
  double count(int axis, double per_feature, int multiple = 1) const;
  /// The same as a frequency, and whether it had to be whole.
  double frequency(int axis, double per_feature, int multiple = 1) const;
  bool wraps(int axis) const;
  /// Width of what one sample stands for.
  float footprint() const { return step_x / static_cast<float>(samples); }
  float extent(int axis) const;

  /// A lattice with so many steps a feature; `layer` makes it independent of others.
  template <int D>
  Lattice<D> lattice(std::uint32_t layer, std::array<double, D> per_feature) const {
    Lattice<D> result;
    for (int d = 0; d < D; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      result.frequency[axis] = static_cast<float>(frequency(d, per_feature[axis]));
      if (wraps(d)) result.period[axis] = static_cast<int>(count(d, per_feature[axis]));
    }
    result.seed = random.stream(layer).bits();
    return result;
  }
  template <int D>
  Lattice<D> lattice(std::uint32_t layer, double per_feature) const {
    return lattice<D>(layer, filled<D>(per_feature));
  }

  /// Cells of a pattern: columns and rows a feature, in whole multiples where the picture tiles.
  Lattice<2> grid(std::uint32_t layer, double columns, double rows, int column_multiple = 1,
                  int row_multiple = 1) const;

  template <int D>
  Fractal<D> fractal(std::uint32_t layer, std::array<double, D> per_feature, int octaves,
                     double gain = 0.5, double lacunarity = 2) const {
    Fractal<D> result;
    result.octaves = octaves;
    double amplitude = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(octaves); ++k) {
      if (k > 0 && too_fine(*std::max_element(per_feature.begin(), per_feature.end()))) {
        result.octaves = static_cast<int>(k);
        break;
      }
      const std::uint32_t stream = layer * 64 + static_cast<std::uint32_t>(k);
      result.lattice[k] = lattice<D>(stream, per_feature);
      // Lattices of all octaves would meet at the first one's points, where all noise is zero.
      Random shift = random.stream(stream).stream(1);
      if (k > 0)
        for (float& offset : result.lattice[k].offset) offset = shift.uniform();
      result.amplitude[k] = static_cast<float>(amplitude);
      result.total += result.amplitude[k];
      amplitude *= gain;
      for (double& frequency : per_feature) frequency *= lacunarity;
    }
    return result;
  }
  template <int D>
  Fractal<D> fractal(std::uint32_t layer, double per_feature, int octaves, double gain = 0.5,
                     double lacunarity = 2) const {
    return fractal<D>(layer, filled<D>(per_feature), octaves, gain, lacunarity);
  }

  template <int D>
  Warp<D> warp(std::uint32_t layer, double per_feature, int octaves, double amount) const {
    Warp<D> result;
    for (std::uint32_t d = 0; d < D; ++d)
      result.axis[d] = fractal<D>((layer + 1) * 1024 + d, per_feature, octaves);
    result.amount = static_cast<float>(amount);
    return result;
  }

 private:
  /// No sampling sees what is a sixteenth of a pixel; and lattice coordinates must stay integers.
  bool too_fine(double per_feature) const { return per_feature * static_cast<double>(step_x) > 16; }
  template <int D>
  static std::array<double, D> filled(double value) {
    std::array<double, D> all;
    all.fill(value);
    return all;
  }
};

}  // namespace gramloom
