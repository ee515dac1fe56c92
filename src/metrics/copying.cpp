#include "metrics/copying.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "core/simd.h"
#include "core/threads.h"
#include "metrics/components.h"
#include "signal/nearest_patches.h"

namespace gramloom {

namespace {

constexpr int block_step = 4;

/// Mean over a block's pixels of the squared deviation from its mean, all components together.
double block_variance(const Image& image, int left, int top) {
  double squares = 0, sums[component_count] = {};
  for (int y = top; y < top + copy_block; ++y)
    for (int x = left; x < left + copy_block; ++x)
      for (int c = 0; c < component_count; ++c) {
        const double v = double{image.at(x, y)[c]};
        sums[c] += v;
        squares += v * v;
      }
  constexpr double pixels = copy_block * copy_block;
  for (const double sum : sums) squares -= sum * sum / pixels;
  return squares / pixels;
}

/// Mean over the pixels of the squared difference; more than `limit` once it must exceed that.
double block_difference(const Image& image, int left, int top, const Image& exemplar,
                        PatchOrigin from, double limit) {
  constexpr double pixels = copy_block * copy_block;
  double sum = 0;
  for (int y = 0; y < copy_block && sum <= limit * pixels; ++y) {
    const float *a = image.at(left, top + y), *b = exemplar.at(from.x, from.y + y);
    float row = 0;
    for (int i = 0; i < copy_block * component_count; ++i) row += (a[i] - b[i]) * (a[i] - b[i]);
    sum += double{row};
  }
  return sum / pixels;
}

/// Whether the block, of this variance, is a copy from where one of its patches is from.
bool is_copied(const PatchField& field, const Image& image, int left, int top,
               const Image& exemplar, double variance) {
  constexpr int far = copy_block - field_patch;
  constexpr int places[][2] = {{far / 2, far / 2}, {0, 0}, {far, 0}, {0, far}, {far, far}};
  std::array<PatchOrigin, std::size(places)> origins;  // of the block, by each of the patches
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const auto [x, y] = places[i];
    const PatchOrigin from = field.nearest[field.index(left + x, top + y)];
    origins[i] = {from.x - x, from.y - y};
  }
  const bool agreed = std::count(origins.begin(), origins.end(), origins[0]) == std::ssize(origins);
  const double limit = variance * (agreed ? copy_tolerance_agreed : copy_tolerance);
  return std::any_of(origins.begin(), origins.end(), [&](PatchOrigin from) {
    return from.x >= 0 && from.y >= 0 && from.x + copy_block <= exemplar.width &&
           from.y + copy_block <= exemplar.height &&
           block_difference(image, left, top, exemplar, from, limit) <= limit;
  });
}

/// Where the blocks are, along one side: every block_step pixels, and the last that fits.
std::vector<int> block_places(int length) {
  std::vector<int> places;
  for (int i = 0; i + copy_block < length; i += block_step) places.push_back(i);
  places.push_back(length - copy_block);
  return places;
}

enum Mark : char { flat, counted, copied };

/// A mark for each pixel: the highest of the blocks that cover it.
std::vector<char> mark_blocks(const PatchField& field, const Image& image, const Image& exemplar) {
  const auto columns = block_places(image.width), rows = block_places(image.height);
  std::vector<char> of_block(columns.size() * rows.size());
  parallel_for(
      static_cast<std::int64_t>(rows.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto r = static_cast<std::size_t>(begin); r < static_cast<std::size_t>(end); ++r)
          for (std::size_t c = 0; c < columns.size(); ++c) {
            const double variance = block_variance(image, columns[c], rows[r]);
            const bool is_copy = variance >= copy_flat &&
                                 is_copied(field, image, columns[c], rows[r], exemplar, variance);
            of_block[r * columns.size() + c] = is_copy                ? copied
                                               : variance < copy_flat ? flat
                                                                      : counted;
          }
      });
  std::vector<char> marks(image.pixels.size() / component_count, flat);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (int y = rows[r]; y < rows[r] + copy_block; ++y)
        for (int x = columns[c]; x < columns[c] + copy_block; ++x) {
          char& mark = marks[image.index(x, y) / component_count];
          mark = std::max(mark, of_block[r * columns.size() + c]);
        }
  return marks;
}

double coherence(const PatchField& field) {
  std::int64_t pairs = 0, together = 0;
  const auto look = [&](int x, int y, int dx, int dy) {
    const PatchOrigin a = field.nearest[field.index(x, y)];
    const PatchOrigin b = field.nearest[field.index(x + dx, y + dy)];
    ++pairs;
    if (b.x - a.x == dx && b.y - a.y == dy) ++together;
  };
  for (int y = 0; y < field.size.height; ++y)
    for (int x = 0; x < field.size.width; ++x) {
      if (x + 1 < field.size.width) look(x, y, 1, 0);
      if (y + 1 < field.size.height) look(x, y, 0, 1);
    }
  return pairs > 0 ? static_cast<double>(together) / static_cast<double>(pairs) : 0;
}

/// Where pixel (x, y) is from, as the middle of its patch (or the nearest patch's) tells.
PatchOrigin found_origin(const PatchField& field, int x, int y) {
  constexpr int middle = field_patch / 2;
  const int px = std::clamp(x - middle, 0, field.size.width - 1);
  const int py = std::clamp(y - middle, 0, field.size.height - 1);
  const PatchOrigin from = field.nearest[field.index(px, py)];
  return {from.x + x - px, from.y + y - py};
}

/// A pixel's colour is that of its source, or where that is not known, of its found origin.
Image draw_map(const PatchField& field, const SourceMap& source, const std::vector<char>& marks,
               const Image& image, const Image& exemplar) {
  Image map(image.size(), 3);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      PatchOrigin from = found_origin(field, x, y);
      if (x < source.size.width && y < source.size.height)
        from = {static_cast<int>(source.at(x, y)->x), static_cast<int>(source.at(x, y)->y)};
      const float u = static_cast<float>(std::clamp(from.x, 0, exemplar.width - 1)) /
                      static_cast<float>(exemplar.width - 1);
      const float v = static_cast<float>(std::clamp(from.y, 0, exemplar.height - 1)) /
                      static_cast<float>(exemplar.height - 1);
      const float light = marks[image.index(x, y) / component_count] == copied ? 1.0f : 1.0f / 3;
      float* out = map.at(x, y);
      out[0] = light * u;
      out[1] = light * v;
      out[2] = light * (1 - (u + v) / 2);
    }
  return map;
}

}  // namespace

Copying copying(const Image& exemplar, const PatchTree& tree, const Image& image,
                const SourceMap& source) {
  const PatchField field = nearest_patches(image, exemplar, tree);
  const std::vector<char> marks = mark_blocks(field, image, exemplar);
  const auto copies = std::count(marks.begin(), marks.end(), copied);
  const auto all = copies + std::count(marks.begin(), marks.end(), counted);
  return {all > 0 ? static_cast<double>(copies) / static_cast<double>(all) : 0, coherence(field),
          draw_map(field, source, marks, image, exemplar)};
}

Image source_colours(const SourceMap& source, const std::vector<Size>& exemplars) {
  Image map(source.size, 3);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Source from = *source.at(x, y);
      const Size size = exemplars.at(from.exemplar);
      const float u = static_cast<float>(from.x) / static_cast<float>(std::max(1, size.width - 1));
      const float v = static_cast<float>(from.y) / static_cast<float>(std::max(1, size.height - 1));
      const std::array<float, 3> colour{u, v, 1 - (u + v) / 2};
      for (std::size_t c = 0; c < 3; ++c) map.at(x, y)[(c + from.exemplar) % 3] = colour[c];
    }
  return map;
}

}  // namespace gramloom
