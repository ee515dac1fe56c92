// The parts of the accelerated search, against the exact one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "classic/pixel_algorithms.h"
#include "classic/pixel_features.h"

namespace gramloom::pixel {
namespace {

Image waves(Size size) {
  Image image(size, 3);
  Random random(5);
  for (int wave = 0; wave < 8; ++wave) {
    const float fx = random.uniform(-0.8f, 0.8f), fy = random.uniform(-0.8f, 0.8f);
    for (int c = 0; c < 3; ++c) {
      const float phase = random.uniform(0.0f, 6.28f);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          image.at(x, y)[c] +=
              std::sin(fx * static_cast<float>(x) + fy * static_cast<float>(y) + phase) +
              0.3f * random.normal();
    }
  }
  return image;
}

TEST(PixelSearch, FeatureDistancesNeverExceedAndMostlyHoldTheNeighbourhoods) {
  const Level level = make_levels(waves({48, 40}), 1).front();
  const int radius = 3;
  const auto features = make_features(level, make_projection(level, radius, Random(1)));
  const Reference reference(level, radius);
  const auto weights = gaussian_weights(radius);
  const Image padded = mirrored(level.colours, radius);
  double projected = 0, whole = 0;
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const auto inside = [&](int side) {
      return radius + static_cast<int>(random.below(static_cast<std::uint32_t>(side - 2 * radius)));
    };
    const int a = level.index({inside(48), inside(40)});
    const int b = level.index({inside(48), inside(40)});
    std::vector<Known> about;
    auto weight = weights.begin();
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx)
        about.push_back(
            {reference.offset(dx, dy), *weight++,
             padded.at(level.point(a).x + radius + dx, level.point(a).y + radius + dy)});
    const auto exact = static_cast<double>(reference.error(about, level.point(b)));
    const auto near = static_cast<double>(squared_distance(features[static_cast<std::size_t>(a)],
                                                           features[static_cast<std::size_t>(b)]));
    EXPECT_LE(near, exact * 1.0001 + 1e-5);
    EXPECT_NEAR(static_cast<double>(reference.errors(about)[static_cast<std::size_t>(b)]), exact,
                1e-4 * exact + 1e-5);
    projected += near;
    whole += exact;
  }
  EXPECT_GT(projected, 0.7 * whole);
}

TEST(PixelSearch, SimilarSamplesAreNearlyTheNearest) {
  const Level level = make_levels(waves({56, 48}), 1).front();
  const auto features = make_features(level, make_projection(level, 3, Random(1)));
  const int count = 4, apart = 3;
  const auto similar = similar_samples(level, features, count, apart, Random(3));
  const auto distance = [&](int a, int b) {
    return static_cast<double>(std::sqrt(squared_distance(features[static_cast<std::size_t>(a)],
                                                          features[static_cast<std::size_t>(b)])));
  };
  double found = 0, best = 0;
  for (int s = 0; s < level.count(); ++s) {
    const auto* list = similar.data() + static_cast<std::size_t>(s * count);
    EXPECT_EQ(list[0], level.point(s));
    std::vector<double> all;
    for (int other = 0; other < level.count(); ++other) {
      const Point p = level.point(s), q = level.point(other);
      if (std::abs(p.x - q.x) >= apart || std::abs(p.y - q.y) >= apart)
        all.push_back(distance(s, other));
    }
    std::partial_sort(all.begin(), all.begin() + count - 1, all.end());
    std::set<int> seen;
    for (int i = 1; i < count; ++i) {
      const Point p = level.point(s), q = list[i];
      EXPECT_TRUE(std::abs(p.x - q.x) >= apart || std::abs(p.y - q.y) >= apart);
      EXPECT_TRUE(seen.insert(level.index(q)).second);
      const double here = distance(s, level.index(q));
      EXPECT_GE(here, all[static_cast<std::size_t>(i - 1)] * 0.9999);
      found += here;
      best += all[static_cast<std::size_t>(i - 1)];
    }
  }
  RecordProperty("factor", std::to_string(found / best));
  EXPECT_LE(found, 1.15 * best);
}

std::vector<Known> about(const Canvas& canvas, const Level& level, const Reference& reference,
                         int radius, int x, int y) {
  const auto weights = gaussian_weights(radius);
  std::vector<Known> found;
  auto weight = weights.begin();
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx, ++weight) {
      int near_x = x + dx, near_y = y + dy;
      if (!canvas.wrap(near_x, near_y)) continue;
      const Point p = canvas.at(near_x, near_y);
      found.push_back({reference.offset(dx, dy), *weight, level.colours.at(p.x, p.y)});
    }
  return found;
}

/// Mean distances from a result's neighbourhoods to the exemplar's: to the nearest of all, and to
/// the nearest of the coherent candidates.
struct Misfit {
  double of_all = 0;
  double of_coherent = 0;
};
Misfit misfit(const Canvas& canvas, const Level& level, const Similar& similar, int radius) {
  const Reference reference(level, radius);
  const std::vector<bool> known(canvas.source.size(), true);
  Misfit misfit;
  int count = 0;
  for (int y = 0; y < canvas.size.height; y += 3)
    for (int x = 0; x < canvas.size.width; x += 3, ++count) {
      const auto near = about(canvas, level, reference, radius, x, y);
      const auto errors = reference.errors(near);
      misfit.of_all +=
          std::sqrt(static_cast<double>(*std::min_element(errors.begin(), errors.end())));
      float least = INFINITY;
      for (const Point p : coherent_candidates(canvas, known, level, similar, x, y))
        least = std::min(least, reference.error(near, p));
      misfit.of_coherent += std::sqrt(static_cast<double>(least));
    }
  return {misfit.of_all / count, misfit.of_coherent / count};
}

TEST(PixelSearch, CoherenceLosesLittleAgainstExact) {
  const Image exemplar = waves({40, 40});
  const Level level = make_levels(exemplar, 1).front();
  const PixelParams defaults;
  const Similar similar = make_similar(defaults, level, Random(4));
  for (const auto method : {lefebvre_hoppe, wei_levoy, efros_leung}) {
    Misfit found[2];
    for (const PixelSearch search : {PixelSearch::coherence, PixelSearch::exact}) {
      PixelParams params;
      params.search = search;
      const Exemplar material{exemplar};
      const Image none;
      const Canvas canvas =
          method(params, {material, {40, 40}, Tile::both, none, none, none, none}, Random(1), {});
      found[static_cast<int>(search)] = misfit(canvas, level, similar, params.radius);
    }
    const auto& [coherence, exact] = found;
    const auto note = fmt::format("coherence {:.4f} ({:.4f} by its own search), exact {:.4f}",
                                  coherence.of_all, coherence.of_coherent, exact.of_all);
    // What the accelerated search finds for a pixel, against the nearest there is.
    EXPECT_LE(coherence.of_coherent, 1.25 * coherence.of_all) << note;
    // The result as a whole, against the result of the exact search.
    EXPECT_LE(coherence.of_all, 1.1 * exact.of_all) << note;
    std::cout << note << "\n";
  }
}

}  // namespace
}  // namespace gramloom::pixel
