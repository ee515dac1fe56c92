#include "neural/directed_levels.h"

#include <algorithm>

#include "neural/settings.h"

namespace gramloom::neural {

int directed_levels(const NeuralParams& params, const Guidance& guidance, Size exemplar,
                    int levels) {
  if (params.levels > 0) return levels;
  constexpr std::ptrdiff_t few = 64;
  constexpr double narrow = 4;  // half its width
  const auto patch = [&](int level) {
    int side = *std::ranges::max_element(params.patch_sizes);
    if (params.layout == Layout::flow)
      side = std::max(side, at_level(params.flow_patch_sizes, level));
    return side;
  };
  const auto has_patches = [&](int level) {
    const Size size = level_size(params, exemplar, level);
    if (guidance.usable.empty()) return true;
    const auto origins =
        usable_origins(scaled_mask(guidance.usable, size), size, {patch(level), patch(level)});
    return std::ranges::count(origins, 1) >= few;
  };
  while (levels > 1 && !has_patches(levels - 1)) --levels;
  if (!guidance.fills()) return levels;
  const double wide = std::ranges::max(steps_to_known(guidance.made));
  const auto is_narrow = [&](int level) {
    return wide * level_size(params, exemplar, level).width / exemplar.width <= narrow;
  };
  while (levels > 1 && is_narrow(levels - 2)) --levels;
  return levels;
}

}  // namespace gramloom::neural
