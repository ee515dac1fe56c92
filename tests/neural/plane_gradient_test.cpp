#include "neural/network/plane_gradient.h"

#include <gtest/gtest.h>

#include "core/threads.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

struct Shape {
  std::int64_t inputs, outputs, kernel, dilation, height, width;  // of the outputs' maps
};

// More outputs than a block of channels has, rows for one share and for several, filters that reach
// further than the picture is large.
const std::vector<Shape> shapes{{1, 1, 1, 1, 1, 1},    {3, 5, 3, 1, 4, 7},    {2, 17, 5, 2, 9, 6},
                                {3, 48, 7, 1, 33, 20}, {4, 20, 3, 16, 70, 8}, {1, 33, 7, 4, 50, 11},
                                {3, 16, 1, 3, 40, 5}};

at::Tensor weights_of(const Shape& s) {
  return numbers({s.outputs, s.inputs, s.kernel, s.kernel}, 1);
}
at::Tensor maps_of(const Shape& s, std::uint64_t seed) {
  return numbers({s.outputs, s.height, s.width}, seed);
}

// As the header writes it.
at::Tensor by_definition(const at::Tensor& maps, const at::Tensor& filters, const Shape& s) {
  const std::int64_t span = (s.kernel - 1) * s.dilation;
  at::Tensor result = at::zeros({s.inputs, s.height + span, s.width + span}, at::kDouble);
  auto r = result.accessor<double, 3>();
  const auto u = maps.accessor<float, 3>();
  const auto w = filters.accessor<float, 4>();
  for (std::int64_t o = 0; o < s.outputs; ++o)
    for (std::int64_t i = 0; i < s.inputs; ++i)
      for (std::int64_t ky = 0; ky < s.kernel; ++ky)
        for (std::int64_t kx = 0; kx < s.kernel; ++kx)
          for (std::int64_t y = 0; y < s.height; ++y)
            for (std::int64_t x = 0; x < s.width; ++x)
              r[i][y + ky * s.dilation][x + kx * s.dilation] +=
                  static_cast<double>(w[o][i][ky][kx]) * static_cast<double>(u[o][y][x]);
  return result;
}

TEST(PlaneGradient, IsItsDefinition) {
  for (const Shape& s : shapes) {
    const at::Tensor maps = maps_of(s, 2), filters = weights_of(s);
    const at::Tensor found = plane_gradient(to_maps(maps).data, filters, s.dilation);
    EXPECT_LT(relative_difference(found, by_definition(maps, filters, s)), 1e-5)
        << s.inputs << " inputs, " << s.outputs << " outputs, kernel " << s.kernel;
  }
}

// Of f(x) = ½ Σ (w ⋆ x)², whose gradient with respect to w ⋆ x is w ⋆ x itself.
TEST(PlaneGradient, MatchesFiniteDifferences) {
  for (const Shape& s : shapes) {
    const std::int64_t span = (s.kernel - 1) * s.dilation;
    const at::Tensor filters = weights_of(s);
    const auto convolved = [&](const at::Tensor& x) {
      const std::int64_t one = 1, none = 0;
      const at::IntArrayRef stride(one), padding(none), dilation(s.dilation);
      return at::conv2d(x.unsqueeze(0), filters.to(at::kDouble), at::Tensor(), stride, padding,
                        dilation)
          .squeeze(0);
    };
    const auto f = [&](const at::Tensor& x) {
      return convolved(x).square().sum().item<double>() / 2;
    };
    const at::Tensor x = numbers({s.inputs, s.height + span, s.width + span}, 3, at::kDouble);
    const at::Tensor gradient =
        plane_gradient(to_maps(convolved(x).to(at::kFloat)).data, filters, s.dilation)
            .to(at::kDouble);
    for (std::uint64_t trial = 0; trial < 3; ++trial) {
      const at::Tensor direction = numbers(x.sizes(), 10 + trial, at::kDouble);
      const double h = 1e-4;
      const double difference = (f(x + h * direction) - f(x - h * direction)) / (2 * h);
      EXPECT_NEAR((gradient * direction).sum().item<double>(), difference,
                  1e-5 * gradient.norm().item<double>() * direction.norm().item<double>());
    }
  }
}

TEST(PlaneGradient, TheSameBytesForAnyThreads) {
  for (const Shape& s : shapes) {
    const at::Tensor maps = to_maps(maps_of(s, 4)).data, filters = weights_of(s);
    std::vector<at::Tensor> results;
    for (const int threads : {1, 2, 5}) {
      set_thread_count(threads);
      results.push_back(plane_gradient(maps, filters, s.dilation));
    }
    set_thread_count(0);
    EXPECT_TRUE(at::equal(results[0], results[1]));
    EXPECT_TRUE(at::equal(results[0], results[2]));
  }
}

}  // namespace
}  // namespace gramloom::neural
