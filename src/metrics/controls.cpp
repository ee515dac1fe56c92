#include "metrics/controls.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/abilities.h"
#include "core/error.h"
#include "signal/random_phase.h"

namespace gramloom {

namespace {

void shuffle(std::vector<std::size_t>& values, Random& random) {
  for (std::size_t left = values.size(); left > 1; --left)
    std::swap(values[left - 1], values[random.below(static_cast<std::uint32_t>(left))]);
}

Image shuffled(const Image& exemplar, Size size, Random random) {
  Image result(size, exemplar.channels);
  const auto channels = static_cast<std::size_t>(exemplar.channels);
  const std::size_t count = exemplar.pixels.size() / channels;
  std::vector<std::size_t> from(result.pixels.size() / channels);
  for (std::size_t start = 0; start < from.size(); start += count) {
    std::vector<std::size_t> round(count);
    std::iota(round.begin(), round.end(), 0);
    shuffle(round, random);  // so that a rest of less than a round is a random one
    std::copy_n(round.begin(), std::min(count, from.size() - start),
                from.begin() + static_cast<std::ptrdiff_t>(start));
  }
  shuffle(from, random);
  for (std::size_t i = 0; i < from.size(); ++i)
    std::copy_n(exemplar.pixels.data() + from[i] * channels, channels,
                result.pixels.data() + i * channels);
  return result;
}

/// The exemplar, repeated, from pixel (left, top) on.
Image window(const Image& exemplar, int left, int top, Size size) {
  Image result(size, exemplar.channels);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      std::copy_n(exemplar.at((left + x) % exemplar.width, (top + y) % exemplar.height),
                  exemplar.channels, result.at(x, y));
  return result;
}

ControlPair halves(const Image& exemplar) {
  const bool across = exemplar.width >= exemplar.height;
  const Size half{across ? exemplar.width / 2 : exemplar.width,
                  across ? exemplar.height : exemplar.height / 2};
  if (half.width < 1 || half.height < 1) throw Error("an exemplar of one pixel has no halves");
  return {window(exemplar, 0, 0, half),
          window(exemplar, across ? half.width : 0, across ? 0 : half.height, half)};
}

}  // namespace

ControlPair control_pair(ControlKind kind, const Image& exemplar, Size size, Random random) {
  check_picture(exemplar);
  check_size(size);
  switch (kind) {
    case ControlKind::shuffled:
      return {exemplar, shuffled(exemplar, size, random)};
    case ControlKind::random_phase:
      return {exemplar, random_phase_texture(exemplar, size, Tile::none, usual_fade, random)};
    case ControlKind::tiled:
      return {exemplar, window(exemplar, 0, 0, size)};
    case ControlKind::halves:
      break;
  }
  return halves(exemplar);
}

}  // namespace gramloom
