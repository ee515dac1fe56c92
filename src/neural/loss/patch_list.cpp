#include "neural/loss/patch_list.h"

#include <algorithm>
#include <memory>
#include <oneapi/dnnl/dnnl.hpp>

#include "core/threads.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t places_at_once = 512;  // whose patches are multiplied: they fit the cache

// Calls f(first value of a row of the patch in the picture, count, first one in the patch) for the
// rows of a patch, in pieces where it goes on across an edge.
template <class F>
void for_each_piece_of(const at::Tensor& picture, std::int64_t side, PatchPlace place, F&& f) {
  const std::int64_t height = picture.size(1), width = picture.size(2);
  std::int64_t line = 0;
  for (std::int64_t c = 0; c < picture.size(0); ++c)
    for (std::int64_t y = 0; y < side; ++y, line += side) {
      const std::int64_t row = (c * height + (place.y + y) % height) * width;
      for (std::int64_t x = 0; x < side;) {
        const std::int64_t from = (place.x + x) % width;
        const std::int64_t count = std::min(side - x, width - from);
        f(row + from, count, line + x);
        x += count;
      }
    }
}

std::unique_ptr<float[]> floats(std::int64_t count) {
  return std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(count));
}

}  // namespace

at::Tensor project_list(const at::Tensor& picture, const at::Tensor& filters,
                        const std::vector<PatchPlace>& places) {
  const at::Tensor pixels = picture.contiguous(), weights = filters.contiguous();
  const std::int64_t side = filters.size(2), taps = picture.size(0) * side * side;
  const std::int64_t directions = filters.size(0), count = std::ssize(places);
  at::Tensor result = at::empty({directions, count}, at::kFloat);
  const float *source = pixels.data_ptr<float>(), *filter = weights.data_ptr<float>();
  float* target = result.data_ptr<float>();
  parallel_for(count, places_at_once, [&](std::int64_t begin, std::int64_t end) {
    const InThisThread in_this_thread;
    const auto patches = floats(taps * places_at_once);
    for (std::int64_t first = begin; first < end; first += places_at_once) {
      const std::int64_t some = std::min(places_at_once, end - first);
      for (std::int64_t i = 0; i < some; ++i)
        for_each_piece_of(pixels, side, places[static_cast<std::size_t>(first + i)],
                          [&](std::int64_t from, std::int64_t values, std::int64_t to) {
                            std::copy_n(source + from, values, patches.get() + i * taps + to);
                          });
      dnnl::sgemm('N', 'T', directions, some, taps, 1, filter, taps, patches.get(), taps, 0,
                  target + first, count);
    }
  });
  return result;
}

void spread_list(const at::Tensor& slopes, const at::Tensor& filters,
                 const std::vector<PatchPlace>& places, at::Tensor& gradient) {
  const at::Tensor values = slopes.contiguous(), weights = filters.contiguous();
  const std::int64_t side = filters.size(2), taps = gradient.size(0) * side * side;
  const std::int64_t directions = filters.size(0), count = std::ssize(places);
  const std::int64_t height = gradient.size(1);
  const float *source = values.data_ptr<float>(), *filter = weights.data_ptr<float>();
  float* target = gradient.data_ptr<float>();
  // Rows are shared out, at least a patch's height to each share, so that what a share adds reaches
  // no further than into the next one, and that of the last into the first. Their number is even,
  // or 1: no two of one parity add to the same row.
  const std::int64_t shares = std::max<std::int64_t>(1, height / side / 2 * 2);
  const auto first_of = [&](std::int64_t share) {
    const std::int64_t row = share * height / shares;
    return std::ranges::lower_bound(places, row, {}, [](PatchPlace p) { return p.y; }) -
           places.begin();
  };
  const auto add_share = [&](std::int64_t share, float* patches) {
    const std::int64_t end = share + 1 == shares ? count : first_of(share + 1);
    for (std::int64_t first = first_of(share); first < end; first += places_at_once) {
      const std::int64_t some = std::min(places_at_once, end - first);
      dnnl::sgemm('T', 'N', some, taps, directions, 1, source + first, count, filter, taps, 0,
                  patches, taps);
      for (std::int64_t i = 0; i < some; ++i)
        for_each_piece_of(gradient, side, places[static_cast<std::size_t>(first + i)],
                          [&](std::int64_t to, std::int64_t length, std::int64_t from) {
                            const float* in = patches + i * taps + from;
                            for (std::int64_t k = 0; k < length; ++k) target[to + k] += in[k];
                          });
    }
  };
  for (std::int64_t parity = 0; parity < std::min<std::int64_t>(2, shares); ++parity)
    parallel_for((shares + 1 - parity) / 2, 1, [&](std::int64_t begin, std::int64_t end) {
      const InThisThread in_this_thread;
      const auto patches = floats(taps * places_at_once);
      for (std::int64_t i = begin; i < end; ++i) add_share(2 * i + parity, patches.get());
    });
}

}  // namespace gramloom::neural
