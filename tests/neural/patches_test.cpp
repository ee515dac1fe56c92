#include "neural/loss/patches.h"

#include <gtest/gtest.h>
#include <sys/time.h>

#include <csignal>

#include "core/error.h"
#include "core/threads.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

struct PatchCase {
  std::int64_t channels, height, width, kernel;
  Tile wraps;
};

void PrintTo(const PatchCase& c, std::ostream* out) {
  *out << c.channels << " channels of " << c.width << "×" << c.height << ", patches of " << c.kernel
       << ", wraps " << static_cast<int>(c.wraps);
}

at::Tensor brute_force(const at::Tensor& planes, const at::Tensor& filters, Tile wraps) {
  const std::int64_t height = planes.size(1), width = planes.size(2), k = filters.size(2);
  const std::int64_t rows = tiles_y(wraps) ? height : height - k + 1;
  const std::int64_t columns = tiles_x(wraps) ? width : width - k + 1;
  at::Tensor result = at::zeros({filters.size(0), rows * columns}, planes.options());
  const auto picture = planes.accessor<double, 3>();
  const auto filter = filters.accessor<double, 4>();
  auto out = result.accessor<double, 2>();
  for (std::int64_t f = 0; f < filters.size(0); ++f)
    for (std::int64_t y = 0; y < rows; ++y)
      for (std::int64_t x = 0; x < columns; ++x)
        for (std::int64_t c = 0; c < planes.size(0); ++c)
          for (std::int64_t ky = 0; ky < k; ++ky)
            for (std::int64_t kx = 0; kx < k; ++kx)
              out[f][y * columns + x] +=
                  picture[c][(y + ky) % height][(x + kx) % width] * filter[f][c][ky][kx];
  return result;
}

class Patches : public testing::TestWithParam<PatchCase> {
 protected:
  PatchCase c = GetParam();
  at::Tensor planes = numbers({c.channels, c.height, c.width}, 1, at::kDouble);
  at::Tensor filters = numbers({4, c.channels, c.kernel, c.kernel}, 2, at::kDouble);
};

TEST_P(Patches, AreTheSumsWrittenOut) {
  EXPECT_LT(relative_difference(project_patches(planes, filters, c.wraps),
                                brute_force(planes, filters, c.wraps)),
            1e-13);
}

TEST_P(Patches, SpreadingIsTheTranspose) {
  const at::Tensor projected = project_patches(planes, filters, c.wraps);
  const at::Tensor gradient = numbers(projected.sizes(), 3, at::kDouble);
  at::Tensor spread = at::zeros_like(planes);
  spread_patches(gradient, filters, c.wraps, spread);
  const double there = (projected * gradient).sum().item<double>();
  const double back = (planes * spread).sum().item<double>();
  EXPECT_NEAR(there, back, 1e-12 * (projected.norm() * gradient.norm()).item<double>());
}

TEST_P(Patches, SpreadingAddsToWhatIsThere) {
  const at::Tensor projected = project_patches(planes, filters, c.wraps);
  at::Tensor once = at::zeros_like(planes), on_top = planes.clone();
  spread_patches(projected, filters, c.wraps, once);
  spread_patches(projected, filters, c.wraps, on_top);
  EXPECT_LT(relative_difference(on_top, planes + once), 1e-13);
}

TEST_P(Patches, OneThreadGivesTheBytesOfTwo) {
  const at::Tensor pixels = planes.to(at::kFloat), weights = filters.to(at::kFloat);
  const auto both_ways = [&] {
    const at::Tensor projected = project_patches(pixels, weights, c.wraps);
    at::Tensor spread = at::zeros_like(pixels);
    spread_patches(projected, weights, c.wraps, spread);
    return std::pair{projected, spread};
  };
  const auto [projected, spread] = both_ways();
  set_thread_count(1);
  const auto [projected_alone, spread_alone] = both_ways();
  set_thread_count(0);
  EXPECT_TRUE(at::equal(projected, projected_alone));
  EXPECT_TRUE(at::equal(spread, spread_alone));
}

std::vector<PatchCase> patch_cases() {
  std::vector<PatchCase> all;
  for (const Tile wraps : {Tile::none, Tile::x, Tile::y, Tile::both}) {
    for (std::int64_t channels = 1; channels <= 5; ++channels)
      all.push_back({channels, 9 + channels, 13 - channels, 3, wraps});
    all.push_back({2, 7, 7, 7, wraps});      // one patch fits
    all.push_back({2, 9, 9, 1, wraps});      // patches of a pixel
    all.push_back({1, 11, 10, 4, wraps});    // of an even side
    all.push_back({1, 5, 2100, 3, wraps});   // a row of more positions than are taken at once
    all.push_back({1, 2100, 4, 3, wraps});   // several stripes of many rows
    all.push_back({2, 150, 300, 7, wraps});  // several stripes of as many rows as a patch
    all.push_back({1, 12, 2100, 5, wraps});  // and a last one that is lower
  }
  // Smaller than a patch where it wraps: a patch sees a pixel several times.
  all.push_back({3, 2, 9, 5, Tile::y});
  all.push_back({3, 9, 2, 5, Tile::x});
  all.push_back({2, 1, 1, 5, Tile::both});
  all.push_back({2, 2, 3, 7, Tile::both});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Cases, Patches, testing::ValuesIn(patch_cases()));

// oneDNN's products use the register of the stack pointer otherwise: no handler may run meanwhile.
TEST(PatchesUnderSignals, AreTheSame) {
  const at::Tensor planes = numbers({3, 96, 96}, 1), filters = numbers({32, 3, 7, 7}, 2);
  const at::Tensor expected = project_patches(planes, filters, Tile::both);
  struct sigaction before {
  }, nothing{};
  nothing.sa_handler = [](int) {};
  nothing.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &nothing, &before);
  const itimerval often{{0, 200}, {0, 200}}, never{};  // microseconds
  setitimer(ITIMER_REAL, &often, nullptr);
  bool same = true;
  for (int i = 0; i < 100; ++i)
    same = same && at::equal(project_patches(planes, filters, Tile::both), expected);
  setitimer(ITIMER_REAL, &never, nullptr);
  sigaction(SIGALRM, &before, nullptr);
  EXPECT_TRUE(same);
}

TEST(PatchesThatDoNotFit, AreAClearError) {
  const at::Tensor planes = numbers({1, 4, 9}, 1), filters = numbers({2, 1, 5, 5}, 2);
  EXPECT_NO_THROW(project_patches(planes, filters, Tile::y));
  for (const Tile wraps : {Tile::none, Tile::x}) try {
      project_patches(planes, filters, wraps);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "a patch of 5×5 does not fit into a picture of 9×4");
    }
}

}  // namespace
}  // namespace gramloom::neural
