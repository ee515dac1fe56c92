#include "neural/flow/patch_axes.h"

#include <ATen/ATen.h>

#include <algorithm>
#include <memory>
#include <oneapi/dnnl/dnnl.hpp>

#include "core/error.h"
#include "core/threads.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t patches_for_axes = 4000;
constexpr std::int64_t patches_at_once = 256;

// A patch's values, going on across the picture's edges.
void copy_patch(const Image& image, PatchPlace place, int side, float* to) {
  const std::ptrdiff_t row = std::ptrdiff_t{side} * image.channels;
  for (int y = 0; y < side; ++y, to += row) {
    const int from = (place.y + y) % image.height;
    if (place.x + side <= image.width) {
      std::copy_n(image.at(place.x, from), row, to);
    } else {
      for (int x = 0; x < side; ++x)
        std::copy_n(image.at((place.x + x) % image.width, from), image.channels,
                    to + std::ptrdiff_t{x} * image.channels);
    }
  }
}

}  // namespace

Size patch_places(Size image, int side) {
  return {image.width - side + 1, image.height - side + 1};
}

namespace {

// draw(): the place of a patch.
template <class F>
PatchAxes axes_of(const Image& image, int side, int count, F&& draw) {
  const InThisThread in_this_thread;  // the same sums for any number of threads
  const std::int64_t values = std::int64_t{side} * side * image.channels;
  at::Tensor patches = at::empty({patches_for_axes, values}, at::kFloat);
  for (std::int64_t i = 0; i < patches_for_axes; ++i) {
    copy_patch(image, draw(), side, patches.data_ptr<float>() + i * values);
  }
  patches -= patches.mean(0, true);
  const at::Tensor covariance = at::matmul(patches.t(), patches).to(at::kDouble) / patches_for_axes;
  const auto [strengths, vectors] = at::linalg_eigh(covariance);  // rising; columns
  const std::int64_t kept = std::min<std::int64_t>(count, values);
  const at::Tensor strongest =
      vectors.narrow(1, values - kept, kept).flip(1).t().to(at::kFloat).contiguous();
  PatchAxes axes{side, Vectors(kept, values)};
  std::copy_n(strongest.data_ptr<float>(), kept * values, axes.axes.values.data());
  return axes;
}

}  // namespace

PatchAxes patch_axes(const Image& image, int side, int count, Random random) {
  const Size places = patch_places(image.size(), side);
  if (places.width < 1 || places.height < 1)
    throw Error("a patch of {0}×{0} does not fit into a picture of {1}×{2}", side, image.width,
                image.height);
  return axes_of(image, side, count, [&] {
    const auto x = static_cast<int>(random.below(static_cast<std::uint32_t>(places.width)));
    const auto y = static_cast<int>(random.below(static_cast<std::uint32_t>(places.height)));
    return PatchPlace{x, y};
  });
}

PatchAxes patch_axes(const Image& image, int side, int count, Random random,
                     const std::vector<PatchPlace>& places) {
  return axes_of(image, side, count,
                 [&] { return places[random.below(static_cast<std::uint32_t>(places.size()))]; });
}

Vectors project(const Image& image, const std::vector<PatchPlace>& places, const PatchAxes& axes) {
  const std::int64_t values = axes.axes.dimensions, kept = axes.axes.count;
  Vectors result(static_cast<std::int64_t>(places.size()), kept);
  parallel_for(result.count, patches_at_once, [&](std::int64_t begin, std::int64_t end) {
    const InThisThread in_this_thread;
    const auto patches =
        std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>((end - begin) * values));
    for (std::int64_t i = begin; i < end; ++i)
      copy_patch(image, places[static_cast<std::size_t>(i)], axes.side,
                 patches.get() + (i - begin) * values);
    dnnl::sgemm('N', 'T', end - begin, kept, values, 1, patches.get(), values,
                axes.axes.values.data(), values, 0, result.at(begin), kept);
  });
  return result;
}

}  // namespace gramloom::neural
