#include "procedural/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "procedural/fractal.h"
#include "sampling.h"

namespace gramloom {
namespace {

template <int D>
std::array<float, D> random_point(Random& random, float low, float high) {
  std::array<float, D> x;
  for (float& v : x) v = random.uniform(low, high);
  return x;
}

template <int D>
Lattice<D> unit_lattice(std::uint32_t seed = 7, int period = 0) {
  Lattice<D> lattice;
  lattice.frequency.fill(1);
  lattice.period.fill(period);
  lattice.seed = seed;
  return lattice;
}

/// Calls check(dimensions as a constant, basis) for every basis whose noise has gradients.
template <class Check>
void for_gradient_bases(const Check& check) {
  const GradientTable table = gradient_table(Random(3));
  const auto dimensions = [&](auto basis) {
    check(std::integral_constant<int, 1>{}, basis);
    check(std::integral_constant<int, 2>{}, basis);
    check(std::integral_constant<int, 3>{}, basis);
    check(std::integral_constant<int, 4>{}, basis);
  };
  dimensions(ImprovedNoise<>{});
  dimensions(ImprovedNoise<PermutationHash>{{&reference_permutation()}});
  dimensions(GradientNoise{&table});
}
template <class Check>
void for_all_bases(const Check& check) {
  for_gradient_bases(check);
  check(std::integral_constant<int, 2>{}, ValueNoise<>{});
  check(std::integral_constant<int, 3>{}, ValueNoise<>{});
}

TEST(Noise, GradientNoiseIsZeroAtLatticePoints) {
  for_gradient_bases([](auto dimensions, const auto& basis) {
    constexpr int D = decltype(dimensions)::value;
    Random random(1);
    for (int i = 0; i < 50; ++i) {
      auto x = random_point<D>(random, -20, 20);
      for (float& v : x) v = std::round(v);
      EXPECT_EQ(sample<D>([&](const auto& p) { return noise(unit_lattice<D>(), p, basis); }, x), 0);
    }
  });
}

TEST(Noise, StaysInBoundsAndUsesThem) {
  for_all_bases([](auto dimensions, const auto& basis) {
    constexpr int D = decltype(dimensions)::value;
    Random random(2);
    float low = 0, high = 0;
    for (int i = 0; i < 20000; ++i) {
      const float v = sample<D>([&](const auto& p) { return noise(unit_lattice<D>(), p, basis); },
                                random_point<D>(random, -30, 30));
      low = std::min(low, v);
      high = std::max(high, v);
    }
    constexpr float bound[] = {1, 1.012f, 1.037f, 1};  // the largest that gradients can add up to
    EXPECT_LE(high, bound[D - 1]) << D;
    EXPECT_GE(low, -bound[D - 1]) << D;
    EXPECT_GT(high, 0.45f) << D;
    EXPECT_LT(low, -0.45f) << D;
  });
}

TEST(Noise, ValueAndSlopeAreContinuousAcrossCellsAndZero) {
  for_all_bases([](auto dimensions, const auto& basis) {
    constexpr int D = decltype(dimensions)::value;
    Random random(4);
    constexpr float h = 1.0f / 256;
    for (int border = -3; border <= 3; ++border)
      for (int i = 0; i < 20; ++i) {
        auto x = random_point<D>(random, -5, 5);
        const auto at = [&](float offset) {
          auto moved = x;
          moved[static_cast<std::size_t>(i % D)] = static_cast<float>(border) + offset;
          return sample<D>([&](const auto& p) { return noise(unit_lattice<D>(), p, basis); },
                           moved);
        };
        EXPECT_NEAR(at(-1e-5f), at(1e-5f), 2e-4f);
        const float left = (at(0) - at(-h)) / h, right = (at(h) - at(0)) / h;
        EXPECT_NEAR(left, right, 24 * h) << D << " border " << border;  // second derivative × h
      }
  });
}

TEST(Noise, RepeatsExactlyAfterItsPeriod) {
  for_all_bases([](auto dimensions, const auto& basis) {
    constexpr int D = decltype(dimensions)::value;
    for (const int period : {1, 2, 3, 5, 12, 255, 1000}) {
      const auto lattice = unit_lattice<D>(9, period);
      Random random(5);
      for (int i = 0; i < 30; ++i) {
        auto x = random_point<D>(random, -2, 2);
        for (float& v : x) v = std::round(v * 64) / 64;  // exact, with the period added too
        auto moved = x;
        moved[static_cast<std::size_t>(i % D)] += static_cast<float>(period * (i % 5 - 2));
        const auto f = [&](const auto& p) { return noise(lattice, p, basis); };
        EXPECT_EQ(sample<D>(f, x), sample<D>(f, moved)) << D << " period " << period;
      }
    }
  });
}

TEST(Noise, DoesNotRepeatWithoutPeriodAndDependsOnTheSeed) {
  const auto at = [](std::uint32_t seed, float x) {
    return sample<2>([&](const auto& p) { return noise(unit_lattice<2>(seed), p); }, {x, 0.25f});
  };
  int equal = 0;
  for (int i = 0; i < 64; ++i) {
    const float x = static_cast<float>(i) + 0.375f;
    equal += at(1, x) == at(1, x + 256) || at(1, x) == at(2, x);
  }
  EXPECT_LT(equal, 40);  // eight gradients a corner: equal by chance, but not everywhere
  EXPECT_NE(at(1, 0.3f), at(0x80000001u, 0.3f));
}

// Perlin's reference implementation, as published, in double.
double reference_noise(double x, double y, double z) {
  const auto& p = reference_permutation();
  const auto P = [&](int i) { return static_cast<int>(p[static_cast<std::size_t>(i & 255)]); };
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto grad = [](int h, double a, double b, double c) {
    h &= 15;
    const double u = h < 8 ? a : b, v = h < 4 ? b : h == 12 || h == 14 ? a : c;
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
  };
  const int X = static_cast<int>(std::floor(x)), Y = static_cast<int>(std::floor(y)),
            Z = static_cast<int>(std::floor(z));
  x -= std::floor(x), y -= std::floor(y), z -= std::floor(z);
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const int i = k & 1, j = (k >> 1) & 1, l = (k >> 2) & 1;
    const double weight =
        (i ? fade(x) : 1 - fade(x)) * (j ? fade(y) : 1 - fade(y)) * (l ? fade(z) : 1 - fade(z));
    sum += weight * grad(P(P(P(X + i) + Y + j) + Z + l), x - i, y - j, z - l);
  }
  return sum;
}

TEST(Noise, ImprovedNoiseHasThePublishedValues) {
  const ImprovedNoise<PermutationHash> basis{{&reference_permutation()}};
  const auto f = [&](const auto& p) { return noise(unit_lattice<3>(), p, basis); };
  EXPECT_NEAR(sample<3>(f, {3.14f, 42, 7}), 0.13691995878400012, 1e-6);
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const auto x = random_point<3>(random, -100, 100);
    EXPECT_NEAR(sample<3>(f, x),
                reference_noise(static_cast<double>(x[0]), static_cast<double>(x[1]),
                                static_cast<double>(x[2])),
                2e-5);
  }
}

TEST(Noise, TheGradientsOf1985AreUnitVectorsInAllDirections) {
  const GradientTable table = gradient_table(Random(8));
  for (std::size_t d = 0; d < 4; ++d) {
    std::array<float, 4> mean{};
    for (const auto& g : table.gradients[d]) {
      float length2 = 0;
      for (std::size_t axis = 0; axis < 4; ++axis) {
        length2 += g[axis] * g[axis];
        mean[axis] += g[axis] / 256;
        EXPECT_TRUE(axis <= d || g[axis] == 0);
      }
      EXPECT_NEAR(length2, 1, 1e-5);
    }
    for (const float m : mean) EXPECT_NEAR(m, 0, 0.2);
  }
}

TEST(Noise, LinearValueNoiseIsLinearInsideACell) {
  const auto at = [](float x) {
    return sample<1>([&](const auto& p) { return noise(unit_lattice<1>(), p, ValueNoise<true>{}); },
                     {x});
  };
  for (int i = -4; i < 4; ++i) {
    const auto x = static_cast<float>(i);
    EXPECT_NEAR(at(x + 0.25f), 0.75f * at(x) + 0.25f * at(x + 1), 1e-6);
  }
}

/// Power of a square image at (u, v), by the discrete Fourier transform of rows, then columns.
std::vector<double> power_spectrum(const std::vector<float>& image, int n) {
  using Complex = std::complex<double>;
  std::vector<Complex> turn(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    turn[static_cast<std::size_t>(i)] = std::polar(1.0, -2 * std::numbers::pi * i / n);
  std::vector<Complex> data(image.begin(), image.end());
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<Complex> transposed(data.size());
    for (int y = 0; y < n; ++y)
      for (int u = 0; u < n; ++u) {
        Complex sum = 0;
        for (int x = 0; x < n; ++x)
          sum +=
              data[static_cast<std::size_t>(y * n + x)] * turn[static_cast<std::size_t>(u * x % n)];
        transposed[static_cast<std::size_t>(u * n + y)] = sum;
      }
    data = transposed;
  }
  std::vector<double> power;
  for (const Complex& c : data) power.push_back(std::norm(c));
  return power;
}

TEST(Noise, IsBandLimitedAndIsotropic) {
  for_gradient_bases([](auto dimensions, const auto& basis) {
    constexpr int D = decltype(dimensions)::value;
    if constexpr (D == 2 || D == 3) {
      constexpr int n = 96, steps = 16;  // pixels, lattice steps across the picture
      std::vector<double> sectors(4);
      double total = 0, low = 0, high = 0;
      for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        Lattice<D> lattice = unit_lattice<D>(seed, steps);
        lattice.offset.fill(0.37f * static_cast<float>(seed));
        std::vector<float> image;
        for (int y = 0; y < n; ++y)
          for (int x = 0; x < n; ++x) {
            std::array<float, D> at{};
            at[0] = static_cast<float>(x) * steps / n;
            at[1] = static_cast<float>(y) * steps / n;
            image.push_back(sample<D>([&](const auto& p) { return noise(lattice, p, basis); }, at));
          }
        const auto power = power_spectrum(image, n);
        for (int v = 0; v < n; ++v)
          for (int u = 0; u < n; ++u) {
            const double fu = u > n / 2 ? u - n : u, fv = v > n / 2 ? v - n : v;
            const double frequency = std::hypot(fu, fv) / steps,
                         p = power[static_cast<std::size_t>(v * n + u)];
            total += p;
            if (frequency < 0.2) low += p;
            if (frequency > 2) high += p;
            // Sectors of 45° around the axes and the diagonals.
            const double angle = std::atan2(fv, fu) / std::numbers::pi * 4 + 8.5;
            if (frequency > 0) sectors[static_cast<std::size_t>(angle) % 4] += p;
          }
      }
      // A plane through 3-D noise has low frequencies, whatever the noise (Cook, DeRose 2005).
      EXPECT_LT(low / total, D == 2 ? 0.05 : 0.15);
      EXPECT_LT(high / total, 0.05) << D;
      for (const double sector : sectors) EXPECT_NEAR(sector / total, 0.25, 0.06) << D;
    }
  });
}

Fractal<2> two_octaves() {
  Fractal<2> fractal;
  fractal.octaves = 2;
  fractal.lattice[0] = unit_lattice<2>(1);
  fractal.lattice[1] = unit_lattice<2>(2);
  fractal.lattice[1].frequency = {3, 3};
  fractal.amplitude[0] = 1;
  fractal.amplitude[1] = 0.25f;
  fractal.total = 1.25f;
  return fractal;
}

TEST(Fractal, OneOctaveIsItsBasis) {
  Fractal<2> fractal = two_octaves();
  fractal.octaves = 1;
  fractal.total = 1;
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    const auto x = random_point<2>(random, -9, 9);
    const float basis = sample<2>([&](const auto& p) { return noise(fractal.lattice[0], p); }, x);
    EXPECT_EQ(sample<2>([&](const auto& p) { return fractal_sum(fractal, p); }, x), basis);
    EXPECT_EQ(sample<2>([&](const auto& p) { return unit_sum(fractal, p); }, x), basis);
    EXPECT_EQ(sample<2>([&](const auto& p) { return turbulence(fractal, p); }, x), std::abs(basis));
    EXPECT_FLOAT_EQ(sample<2>([&](const auto& p) { return ridged(fractal, p); }, x),
                    (1 - std::abs(basis)) * (1 - std::abs(basis)));
  }
}

TEST(Fractal, SumsAreTheirFormulas) {
  const Fractal<2> fractal = two_octaves();
  Random random(10);
  for (int i = 0; i < 100; ++i) {
    const auto x = random_point<2>(random, -9, 9);
    const float a = sample<2>([&](const auto& p) { return noise(fractal.lattice[0], p); }, x);
    const float b = sample<2>([&](const auto& p) { return noise(fractal.lattice[1], p); }, x);
    EXPECT_FLOAT_EQ(sample<2>([&](const auto& p) { return fractal_sum(fractal, p); }, x),
                    a + 0.25f * b);
    EXPECT_FLOAT_EQ(sample<2>([&](const auto& p) { return turbulence(fractal, p); }, x),
                    std::abs(a) + 0.25f * std::abs(b));
    const float ridge = (1 - std::abs(a)) * (1 - std::abs(a));
    const float next = (1 - std::abs(b)) * (1 - std::abs(b)) * std::min(1.0f, 2 * ridge);
    EXPECT_FLOAT_EQ(sample<2>([&](const auto& p) { return ridged(fractal, p); }, x),
                    ridge + 0.25f * next);
  }
}

TEST(Fractal, WarpMovesByAtMostItsAmount) {
  Warp<2> warp;
  warp.axis = {two_octaves(), two_octaves()};
  warp.amount = 0.5f;
  Random random(11);
  float furthest = 0;
  for (int i = 0; i < 500; ++i) {
    const auto x = random_point<2>(random, -9, 9);
    const float moved =
        std::abs(sample<2>([&](const auto& p) { return warped(warp, p).at[0]; }, x) - x[0]);
    EXPECT_LE(moved, 0.5f);
    furthest = std::max(furthest, moved);
  }
  EXPECT_GT(furthest, 0.1f);
}

}  // namespace
}  // namespace gramloom
