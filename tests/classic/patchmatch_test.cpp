#include "classic/patchmatch.h"

#include <gtest/gtest.h>

#include <numeric>

#include "classic/patch_features.h"
#include "classic/patch_vote.h"
#include "core/error.h"
#include "core/threads.h"
#include "patch_exemplars.h"
#include "signal/patch_field.h"

namespace gramloom {
namespace {

Image optimise(const PatchmatchParams& params, const Image& exemplar, const Target& target,
               std::uint64_t seed = 1) {
  return synthesise(params, {{{exemplar}}, target, Random(seed)}, {}).image;
}

double mean_distance(const PatchField& field) {
  return std::accumulate(field.distance.begin(), field.distance.end(), 0.0) /
         static_cast<double>(field.distance.size());
}

/// A field of random patches between two textures, neither of which is a copy of the other.
struct Trial {
  Image exemplar = patch_features(blobs(48, 40, 3, 1), 0.7);
  Image canvas = patch_features(blobs(56, 50, 3, 2), 0.7);
  Size origins = patch_origins(exemplar.size());
  PatchField field = random_field(patch_origins(canvas.size()), Tile::none, origins, Random(3));
  PatchPenalty none{field.size, origins};
};

TEST(PatchField, SearchOfAllEqualsBruteForce) {
  Trial t;
  search_all(t.field, t.canvas, t.exemplar, t.none);
  for (const auto& [x, y] : {std::pair{0, 0}, {7, 31}, {48, 42}, {20, 20}}) {
    double least = std::numeric_limits<double>::infinity();
    for (int v = 0; v < t.origins.height; ++v)
      for (int u = 0; u < t.origins.width; ++u) {
        double sum = 0;
        for (int j = 0; j < field_patch; ++j)
          for (int i = 0; i < field_patch; ++i)
            for (int c = 0; c < field_features; ++c)
              sum += std::pow(
                  double{t.canvas.at(x + i, y + j)[c]} - double{t.exemplar.at(u + i, v + j)[c]}, 2);
        least = std::min(least, sum);
      }
    EXPECT_NEAR(t.field.distance[t.field.index(x, y)], least, 1e-4 * least);
  }
}

TEST(PatchField, SearchComesWithinATenthOfTheExactOne) {
  Trial t;
  for (int pass = 0; pass < 10; ++pass)
    improve(t.field, t.canvas, t.exemplar, t.none, pass, 4,
            Random(4, static_cast<std::uint64_t>(pass)));
  const double found = mean_distance(t.field);
  search_all(t.field, t.canvas, t.exemplar, t.none);
  EXPECT_GE(found, mean_distance(t.field));
  EXPECT_LT(found, 1.1 * mean_distance(t.field));
}

TEST(PatchField, PenaltyIsAvoided) {
  Trial t;
  for (int y = 0; y < t.origins.height; ++y)
    for (int x = 0; x < t.origins.width / 2; ++x) t.none.of_origin[t.none.index({x, y})] = 1e6f;
  search_all(t.field, t.canvas, t.exemplar, t.none);
  for (const PatchOrigin o : t.field.nearest) EXPECT_GE(o.x, t.origins.width / 2);
}

TEST(PatchVote, AFieldOfExactCopiesGivesTheExemplar) {
  const Image exemplar = patch_features(blobs(40, 30, 3, 5), 0.7);
  PatchField field = blank_field(patch_origins(exemplar.size()), Tile::none);
  for (int y = 0; y < field.size.height; ++y)
    for (int x = 0; x < field.size.width; ++x) field.nearest[field.index(x, y)] = {x, y};
  const Image canvas = vote(field, exemplar, 1e-3f);
  ASSERT_EQ(canvas.size(), exemplar.size());
  for (std::size_t i = 0; i < canvas.pixels.size(); ++i)
    ASSERT_NEAR(canvas.pixels[i], exemplar.pixels[i], 1e-5);
  const auto pixels = choose_pixels(field, canvas, exemplar);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      ASSERT_EQ(pixels[static_cast<std::size_t>(y * 40 + x)], (PatchOrigin{x, y}));
}

TEST(PatchVote, EnergyNeverRises) {
  for (const Tile tile : {Tile::none, Tile::both}) {
    Trial t;
    const Size size = tile == Tile::none ? t.field.size : Size{40, 40};
    PatchField field = random_field(size, tile, t.origins, Random(6));
    PatchPenalty none(size, t.origins);
    constexpr float floor = 0.0064f;
    Image canvas = vote(field, t.exemplar, 1);
    double before = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < 15; ++pass) {
      improve(field, canvas, t.exemplar, none, pass, 4,
              Random(7, static_cast<std::uint64_t>(pass)));
      const double energy = robust_energy(field, floor);
      EXPECT_LE(energy, before * (1 + 1e-6)) << pass;
      before = energy;
      canvas = vote(field, t.exemplar, floor);
    }
  }
}

TEST(PatchPenalty, UsageCountsPatches) {
  PatchField field = blank_field({20, 20}, Tile::none);
  const Size origins{30, 30};
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) field.nearest[field.index(x, y)] = {15, 15};
  const std::vector<float> used = usage(field, origins);
  EXPECT_NEAR(used[15 * 30 + 15], 900.0 / 81, 1e-3);
  EXPECT_EQ(used[0], 0);
  EXPECT_NEAR(std::accumulate(used.begin(), used.end(), 0.0) / 900, 1, 1e-3);
}

// Counted in squares as the rows go by; here as it is defined. Fields that lack patches of most
// shifts, and one that has more of a shift than are allowed in many.
TEST(PatchPenalty, ShiftsArePenalisedAsOftenAsTheyAreUsed) {
  for (const auto& [size, origins] : {std::pair{Size{150, 90}, Size{40, 33}},
                                      {Size{33, 200}, Size{70, 10}},
                                      {Size{40, 30}, Size{90, 140}}}) {
    PatchField field = random_field(size, Tile::both, origins, Random(5));
    for (int y = 0; y < size.height / 2; ++y)
      for (int x = 0; x < size.width; ++x)
        field.nearest[field.index(x, y)] = {(x + 3) % origins.width, (y + 5) % origins.height};
    PatchPenalty penalty(size, origins);
    std::vector<float> expected(static_cast<std::size_t>(penalty.shifts().width) *
                                static_cast<std::size_t>(penalty.shifts().height));
    const auto index = [&](PatchOrigin shift) {
      return static_cast<std::size_t>(shift.y) * static_cast<std::size_t>(penalty.shifts().width) +
             static_cast<std::size_t>(shift.x);
    };
    const float limit = std::max(1.0f, 0.002f * static_cast<float>(origins.width * origins.height));
    for (int round = 0; round < 3; ++round) {
      std::vector<int> counts(expected.size());
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          ++counts[index(penalty.shift(x, y, field.nearest[field.index(x, y)]))];
      for (std::size_t i = 0; i < counts.size(); ++i) {
        const float excess = static_cast<float>(counts[i]) / limit - 1;
        expected[i] += 0.5f * (32 * std::min(4.0f, std::max(0.0f, excess)) - expected[i]);
      }
      update(penalty, field, 0.3, 0.002);
      for (int y = 0; y < penalty.shifts().height; ++y)
        for (int x = 0; x < penalty.shifts().width; ++x)
          ASSERT_EQ(penalty.of_shift.at(x, y), expected[index({x, y})]);
      field = random_field(size, Tile::both, origins, Random(6));
    }
  }
}

TEST(PatchField, AnExemplarTooLargeToNameItsPatchesIsAClearError) {
  const Image exemplar(65'537, 16, 1);
  try {
    optimise({}, exemplar, {{32, 32}, Tile::both});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "an exemplar of 65537×16 is too large to compare its patches: at most 65536 a "
                 "side");
  }
}

TEST(Patchmatch, BoundsWhatIsCopiedAsAWhole) {
  const Image exemplar = blobs(96, 96, 3, 8);
  const Target target{{160, 160}, Tile::none};
  const int area = 96 * 96;
  const int bounded =
      largest_copied_piece(optimise({.largest_copy = 0.1}, exemplar, target), exemplar);
  const int free =
      largest_copied_piece(optimise({.largest_copy = 1000}, exemplar, target), exemplar);
  EXPECT_LT(bounded, 0.2 * area);
  EXPECT_LT(bounded, free);
}

TEST(Patchmatch, UniformityBoundsRepetition) {
  const Image exemplar = blobs(96, 96, 3, 9);
  const Target target{{160, 160}, Tile::none};
  // How much of the exemplar is used: what is used over and over leaves the rest unused.
  const auto used = [&](double uniformity) {
    const Image result = optimise({.uniformity = uniformity}, exemplar, target);
    return static_cast<double>(colours(result).size()) / (96 * 96);
  };
  const double even = used(1);
  EXPECT_GT(even, 0.7);
  EXPECT_GT(even, used(0));
}

TEST(Patchmatch, EveryPixelIsOneOfTheExemplars) {
  const Image exemplar = blobs(60, 50, 3, 10);
  const auto known = colours(exemplar);
  for (const Tile tile : {Tile::none, Tile::x, Tile::y, Tile::both}) {
    const Image result = optimise({}, exemplar, {{93, 71}, tile});
    EXPECT_EQ(result.size(), (Size{93, 71}));
    for (const auto& colour : colours(result)) ASSERT_TRUE(known.contains(colour));
  }
}

TEST(Patchmatch, ContinuesAChessboardExactly) {
  const Image result = optimise({}, chessboard(64, 64, 8), {{96, 80}, Tile::both});
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 96; ++x) {
      ASSERT_NE(*result.at(x, y), *result.at((x + 8) % 96, y)) << x << ' ' << y;
      ASSERT_NE(*result.at(x, y), *result.at(x, (y + 8) % 80)) << x << ' ' << y;
    }
}

TEST(Patchmatch, TilesAcrossTheSeam) {
  const Image exemplar = blobs(96, 96, 3, 11);
  for (const Tile tile : {Tile::x, Tile::y, Tile::both}) {
    const Image result = optimise({}, exemplar, {{121, 104}, tile});
    if (tiles_x(tile)) {
      EXPECT_LT(seam_ratio(result, true), 1);
    }
    if (tiles_y(tile)) {
      EXPECT_LT(seam_ratio(result, false), 1);
    }
  }
  const Image open = optimise({}, exemplar, {{121, 104}, Tile::none});
  EXPECT_GT(seam_ratio(open, true), 3);
  EXPECT_GT(seam_ratio(open, false), 3);
}

TEST(Patchmatch, SameBytesForAnyNumberOfThreads) {
  const Image exemplar = blobs(70, 60, 3, 12);
  for (const Tile tile : {Tile::none, Tile::both}) {
    std::vector<Image> results;
    for (const int threads : {1, 2, 8}) {
      set_thread_count(threads);
      results.push_back(optimise({}, exemplar, {{90, 100}, tile}));
    }
    set_thread_count(0);
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
    EXPECT_NE(results[0], optimise({}, exemplar, {{90, 100}, tile}, 2));
  }
}

TEST(Patchmatch, SmallExemplarsAndTargets) {
  for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{5, 3}, Size{20, 7}})
    for (const Size wanted : {Size{1, 1}, Size{2, 3}, Size{7, 40}, Size{33, 5}})
      for (const Tile tile : {Tile::none, Tile::x, Tile::y, Tile::both}) {
        const Image exemplar = blobs(size.width, size.height, 2, 13);
        const auto known = colours(exemplar);
        const Image result = optimise({}, exemplar, {wanted, tile});
        ASSERT_EQ(result.size(), wanted);
        for (const auto& colour : colours(result)) ASSERT_TRUE(known.contains(colour));
      }
}

TEST(Patchmatch, ConstantStaysConstantAndManyChannelsStay) {
  const Image flat(40, 40, 3, 0.3f);
  EXPECT_EQ(optimise({}, flat, {{50, 60}, Tile::both}), Image(50, 60, 3, 0.3f));
  EXPECT_EQ(optimise({}, blobs(40, 40, 64, 14), {{50, 50}, Tile::both}).channels, 64);
}

TEST(Patchmatch, ReportsProgressAndStops) {
  const Image exemplar = blobs(64, 64, 1, 15);
  std::int64_t last = 0, steps = 0;
  Control control;
  control.progress = [&](const Progress& p) {
    EXPECT_EQ(p.step, last + 1);
    EXPECT_TRUE(std::isfinite(p.loss));
    last = p.step;
    steps = p.steps;
    return true;
  };
  synthesise(PatchmatchParams{}, {{{exemplar}}, {{64, 64}, Tile::none}, Random(1)}, control);
  EXPECT_GT(steps, 10);
  EXPECT_EQ(last, steps);
  control.progress = [](const Progress&) { return false; };
  EXPECT_THROW(
      synthesise(PatchmatchParams{}, {{{exemplar}}, {{64, 64}, Tile::none}, Random(1)}, control),
      Interrupted);
}

TEST(Patchmatch, RefusesWhatCannotBe) {
  const Image exemplar = blobs(20, 20, 1, 16);
  EXPECT_THROW(optimise({.iterations = 0}, exemplar, {}), ConfigError);
  EXPECT_THROW(optimise({}, Image(), {}), Error);
  EXPECT_THROW(optimise({}, exemplar, {{5, 0}, Tile::none}), Error);
}

}  // namespace
}  // namespace gramloom
