#pragma once

#include <filesystem>
#include <vector>

#include "neural/synthesis.h"

namespace gramloom {

// Diagonal stripes with some noise: structure and grain.
inline Image stripes(Size size, int channels) {
  Image image(size, channels);
  Random random(1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < channels; ++c)
        image.at(x, y)[c] = ((x + y + 3 * c) % 8 < 4 ? 0.2f : 0.7f) + 0.1f * random.uniform();
  return image;
}

struct Trace {
  std::vector<Progress> steps;
  Control control(std::int64_t stop_at = -1, std::filesystem::path checkpoint = {},
                  std::string identity = "") {
    return {[this, stop_at](const Progress& progress) {
              steps.push_back(progress);
              return progress.step != stop_at;
            },
            std::move(checkpoint), std::move(identity)};
  }
};

inline Image run(const NeuralParams& params, const Image& exemplar, const Target& target,
                 std::uint64_t seed = 1) {
  return synthesise(params, {{{exemplar}}, target, Random(seed)}, {}).image;
}

inline NeuralParams quick_patches() {
  NeuralParams params;
  params.spectrum_weight = 0.1;
  params.patch_sizes = {5, 3};
  params.directions = 6;
  params.levels = 3;
  params.iterations = {6, 5, 4};
  return params;
}

}  // namespace gramloom
