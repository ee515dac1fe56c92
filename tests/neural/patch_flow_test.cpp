// Patch flow matching: its parts against plain definitions, and what a layout promises.
#include "neural/flow/patch_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "core/threads.h"
#include "courses.h"
#include "neural/flow/band_match.h"
#include "neural/flow/nearest.h"
#include "neural/flow/periodic_part.h"
#include "neural/flow/prices.h"
#include "neural/flow/sparse_detail.h"
#include "neural/flow/vote.h"
#include "neural/picture.h"
#include "neural/resample.h"
#include "neural/settings.h"
#include "syntheses.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

namespace fs = std::filesystem;

Vectors random_vectors(std::int64_t count, std::int64_t dimensions, std::uint64_t seed) {
  Vectors vectors(count, dimensions);
  Random random(seed);
  for (float& value : vectors.values) value = random.normal();
  return vectors;
}

float product(const float* a, const float* b, std::int64_t count) {
  return std::inner_product(a, a + count, b, 0.0f);
}

TEST(NearestReferences, AreThoseOfAPlainSearch) {
  const Vectors queries = random_vectors(130, 7, 1), references = random_vectors(1037, 7, 2);
  std::vector<float> offsets;
  for (std::int64_t r = 0; r < references.count; ++r)
    offsets.push_back(product(references.at(r), references.at(r), 7));
  const Neighbours found = nearest_references(queries, references, offsets, 1, 3);
  for (std::int64_t q = 0; q < queries.count; ++q) {
    std::vector<std::pair<float, std::int32_t>> all;
    for (std::int64_t r = 0; r < references.count; ++r)
      all.emplace_back(
          offsets[static_cast<std::size_t>(r)] - 2 * product(queries.at(q), references.at(r), 7),
          static_cast<std::int32_t>(r));
    std::ranges::sort(all);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = static_cast<std::size_t>(q) * 3 + k;
      EXPECT_NEAR(found.cost[at], all[k].first, 1e-4);
      EXPECT_EQ(found.reference[at], all[k].second);
    }
  }
  EXPECT_EQ(nearest_references(queries, random_vectors(2, 7, 3), {1, 2}, 1, 5).neighbours, 2);
}

// An exemplar of two materials, one on a quarter of it: a picture that is all of the larger one's
// kind uses both by their area nevertheless.
TEST(Prices, MakeAllPatchesUsedAlike) {
  const Size places{40, 40};
  std::vector<PatchPlace> references;
  for (int y = 0; y < places.height; ++y)
    for (int x = 0; x < places.width; ++x) references.push_back({x, y});
  Vectors of_exemplar = random_vectors(places.width * places.height, 6, 4);
  for (std::int64_t r = 0; r < of_exemplar.count; ++r)
    of_exemplar.at(r)[0] += references[static_cast<std::size_t>(r)].x < 10 ? 3.0f : -3.0f;
  Vectors queries = random_vectors(4000, 6, 5);
  for (std::int64_t q = 0; q < queries.count; ++q) queries.at(q)[0] -= 2;
  std::vector<float> norms;
  for (std::int64_t r = 0; r < of_exemplar.count; ++r)
    norms.push_back(product(of_exemplar.at(r), of_exemplar.at(r), 6));
  const auto share_of_small = [&](const std::vector<float>& prices) {
    std::vector<float> offsets = norms;
    for (std::size_t r = 0; r < offsets.size(); ++r) offsets[r] += prices[r];
    const Neighbours nearest = nearest_references(queries, of_exemplar, offsets, 1, 1);
    return static_cast<double>(std::ranges::count_if(
               nearest.reference,
               [&](std::int32_t r) { return references[static_cast<std::size_t>(r)].x < 10; })) /
           static_cast<double>(nearest.reference.size());
  };
  std::vector<float> prices(norms.size());
  EXPECT_LT(share_of_small(prices), 0.1);
  for (int i = 0; i < 60; ++i)
    update_prices({places, prices.data()}, references, queries, of_exemplar, norms, 1, {0.2, 2, 2},
                  Random(6));
  EXPECT_NEAR(share_of_small(prices), 0.25, 0.05);
}

TEST(BandMatch, GivesEachBandItsDeviation) {
  const auto grain = [](Size size, std::uint64_t seed) {  // all scales
    return resample(numbers({2, 8, 8}, seed), size, Tile::both) +
           numbers({2, size.height, size.width}, seed + 1) * 0.3;
  };
  const Image exemplar = to_image(grain({64, 64}, 1));
  Image image = to_image(grain({80, 48}, 3) * 0.6 + 0.3);
  const BandStatistics goal = band_statistics(exemplar, Tile::both, image.size());
  const BandStatistics before = band_statistics(image, Tile::both, exemplar.size());
  match_bands(image, goal);
  const BandStatistics after = band_statistics(image, Tile::both, exemplar.size());
  // Bands overlap: one matching brings each nearer, and their sum of squares all the way.
  for (std::size_t c = 0; c < 2; ++c) {
    double own = 0, wanted = 0;
    for (std::size_t band = 0; band < goal.deviation.size(); ++band) {
      const auto off = [&](const BandStatistics& s) {
        return std::abs(std::log(s.deviation[band][c] / goal.deviation[band][c]));
      };
      EXPECT_LT(off(after), std::max(0.6 * off(before), 0.25)) << band;
      own += after.deviation[band][c] * after.deviation[band][c];
      wanted += goal.deviation[band][c] * goal.deviation[band][c];
    }
    EXPECT_NEAR(own / wanted, 1, 0.1);
    EXPECT_NEAR(after.mean[c], goal.mean[c], 1e-4);
  }
}

TEST(PeriodicPart, OfWhatRepeatsIsItself) {
  Image exemplar({36, 40}, 1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 36; ++x) exemplar.at(x, y)[0] = static_cast<float>(x % 12 + 20 * (y % 8));
  const Image same = periodic_part(exemplar, {12, 5}, {8, 2}, {60, 16});
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 60; ++x) EXPECT_NEAR(same.at(x, y)[0], exemplar.at(x % 36, y)[0], 1e-3);
  const Image rows = periodic_part(exemplar, {}, {8, 3}, {5, 24});
  for (int y = 0; y < 24; ++y) EXPECT_NEAR(rows.at(3, y)[0], 5.5 + 20 * (y % 8), 1e-3);
}

TEST(SparseDetail, IsOfThinLinesAlone) {
  Image lines({96, 96}, 3, 0.1f), stones = to_image(numbers({3, 96, 96}, 3));
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      if ((x + 2 * y) % 31 == 0)
        for (int c = 0; c < 3; ++c) lines.at(x, y)[c] = 0.9f;
  EXPECT_GT(sparse_detail(lines), too_sparse_for_flow);
  EXPECT_LT(sparse_detail(stones), 0.2);
  EXPECT_EQ(sparse_detail(Image({64, 64}, 3, 0.4f)), 0);
}

FlowParams plain_flow() {
  FlowParams params;
  params.flow_patch_sizes = {4};
  params.flow_steps = {3};
  params.flow_neighbours = {2};
  params.flow_price = 0;
  return params;
}

// One step, written as the paper has it: the mean of the exemplar's patches by their likelihood,
// overlapping patches voting. Which of the four grids of patches votes is drawn.
TEST(PatchFlow, AStepIsThePlainDefinitions) {
  const int side = 4, width = 8, height = 10;
  at::Tensor exemplar = numbers({1, 14, 13}, 7);
  exemplar = (exemplar - exemplar.mean()) / exemplar.square().mean().sqrt();
  PatchFlow flow(plain_flow(), exemplar, {{width, height}, Tile::both}, Random(1));
  FlowState state;
  flow.step(state, 0, true);
  const at::Tensor before = state.picture.clone();
  flow.step(state, 0, true);
  const double t = 0.5;  // the second of three steps: times are 1/4, 1/2, 3/4, 1
  const auto in_picture = [&](int x, int y) {
    return before[0][y % height][x % width].item<double>();
  };
  const auto in_exemplar = [&](int x, int y) { return exemplar[0][y][x].item<double>(); };
  const std::vector<float> window = vote_window(side, 0.25);
  double best = 1e9;
  for (int shift = 0; shift < 4; ++shift) {
    Image sum({width, height}, 1), total({width, height}, 1);
    for (int qy = shift / 2; qy < height + shift / 2; qy += 2)
      for (int qx = shift % 2; qx < width + shift % 2; qx += 2) {
        std::vector<std::tuple<double, int, int>> costs;
        for (int ry = 0; ry + side <= 14; ++ry)
          for (int rx = 0; rx + side <= 13; ++rx) {
            double distance = 0;
            for (int y = 0; y < side; ++y)
              for (int x = 0; x < side; ++x) {
                const double d = in_picture(qx + x, qy + y) - t * in_exemplar(rx + x, ry + y);
                distance += d * d;
              }
            costs.emplace_back(distance, rx, ry);
          }
        std::ranges::sort(costs);
        const double second =
            std::exp((std::get<0>(costs[0]) - std::get<0>(costs[1])) / 2 / (1 - t) / (1 - t));
        for (int y = 0; y < side; ++y)
          for (int x = 0; x < side; ++x) {
            const auto value = [&](std::size_t i) {
              return in_exemplar(std::get<1>(costs[i]) + x, std::get<2>(costs[i]) + y);
            };
            const float w = window[static_cast<std::size_t>(y * side + x)];
            const int to_x = (qx + x) % width, to_y = (qy + y) % height;
            sum.at(to_x, to_y)[0] +=
                w * static_cast<float>((value(0) + second * value(1)) / (1 + second));
            total.at(to_x, to_y)[0] += w;
          }
      }
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] /= total.pixels[i];
    match_bands(sum, band_statistics(to_image(exemplar), Tile::none, {width, height}));
    const at::Tensor expected = before + (to_planes(sum) - before) * 0.5;
    best = std::min(best, (state.picture - expected).abs().max().item<double>());
  }
  EXPECT_LT(best, 1e-4);
}

NeuralParams quick_layout() {
  NeuralParams params;
  params.layout = Layout::flow;
  params.levels = 2;
  params.flow_steps = {3, 4};
  params.iterations = {3, 4};
  params.directions = 6;
  return params;
}

TEST(PatchFlow, ThreadsDoNotMatter) {
  NeuralParams params = quick_layout();
  params.originality = 0.3;
  params.iterations = {0};
  const Image exemplar = stripes({160, 120}, 3);
  const Target target{{90, 104}, Tile::x};
  set_thread_count(1);
  const Image alone = run(params, exemplar, target);
  for (const int threads : {2, 3}) {
    set_thread_count(threads);
    EXPECT_EQ(run(params, exemplar, target), alone) << threads;
  }
  set_thread_count(0);
}

TEST(PatchFlow, GoesOnToTheSameBytesFromTheMiddleOfALayout) {
  NeuralParams params = quick_layout();
  params.originality = 0.2;
  const Image exemplar = stripes({96, 96}, 3);
  const Target target{{80, 96}, Tile::both};
  const fs::path checkpoint = fs::path(testing::TempDir()) / "flow.checkpoint";
  fs::remove(checkpoint);
  Trace all;
  const Image whole = synthesise(params, {{{exemplar}}, target, Random(1)}, all.control()).image;
  EXPECT_EQ(all.steps.back().step, 4 + 4 + 3 + 3);
  EXPECT_EQ(all.steps.back().steps, 4 + 4 + 3 + 3);
  for (const std::int64_t stop : {1, 3, 4, 5, 8, 9, 10, 11, 12}) {
    Trace first, second;
    const Image unfinished =
        synthesise(params, {{{exemplar}}, target, Random(1)}, first.control(stop, checkpoint))
            .image;
    EXPECT_EQ(unfinished.size(), target.size);
    EXPECT_EQ(first.steps.back().step, stop);
    ASSERT_TRUE(fs::exists(checkpoint));
    const Image resumed =
        synthesise(params, {{{exemplar}}, target, Random(1)}, second.control(-1, checkpoint)).image;
    EXPECT_EQ(second.steps.front().step, stop + 1);
    EXPECT_EQ(resumed, whole) << "stopped at " << stop;
    fs::remove(checkpoint);
  }
}

TEST(PatchFlow, LaysUnbrokenCoursesAtAnySize) {
  NeuralParams params = with_preset(Preset::fast);
  params.iterations = {10};
  params.directions = 8;
  const Image wall = wall_of_bricks({160, 160}, {40, 16}, 0.1f);
  struct Case {
    Target target;
    int rows, more;
  };
  // Where it tiles, their number is even, as they alternate; the height is no multiple of theirs.
  for (const Case& c : {Case{{{130, 100}, Tile::both}, 6, 0}, Case{{{150, 183}, Tile::both}, 12, 0},
                        Case{{{130, 105}, Tile::none}, 6, 1}}) {
    const int rows = light_rows(run(params, wall, c.target));
    EXPECT_GE(rows, c.rows) << c.target.size.height;
    EXPECT_LE(rows, c.rows + c.more) << c.target.size.height;
  }
}

TEST(Layout, IsAutomaticallyFlowWhereThereAreTwoOctaves) {
  const NeuralParams params;
  const auto chosen = [&](const NeuralParams& p, Size exemplar, Size target) {
    return layout_by_size(p, exemplar, {target, Tile::none});
  };
  EXPECT_EQ(chosen(params, {96, 200}, {256, 256}), Layout::flow);
  EXPECT_EQ(chosen(params, {95, 200}, {256, 256}), Layout::noise);
  EXPECT_EQ(chosen(params, {200, 200}, {40, 256}), Layout::noise);
  EXPECT_EQ(chosen(with_preset(Preset::gatys), {256, 256}, {256, 256}), Layout::noise);
  NeuralParams given = params;
  given.levels = 3;
  EXPECT_EQ(chosen(given, {256, 256}, {256, 256}), Layout::noise);
  given = params;
  given.coarsest_side = 16;
  EXPECT_EQ(chosen(given, {256, 256}, {256, 256}), Layout::noise);
  given.layout = Layout::flow;
  EXPECT_THROW(check_settings(given), ConfigError);
  given = params;
  given.originality = 0.5;
  EXPECT_NO_THROW(check_settings(given));
  given.layout = Layout::noise;
  EXPECT_THROW(check_settings(given), ConfigError);
  given = params;
  given.layout = Layout::flow;
  EXPECT_EQ(chosen(given, {50, 50}, {256, 256}), Layout::flow);
}

TEST(Layout, OfTooSmallAnExemplarIsRefusedBeforehand) {
  NeuralParams params;
  params.layout = Layout::flow;
  EXPECT_NO_THROW(estimate(params, {{{{8, 8}, 3}}, {64, 64}, Tile::both}));
  EXPECT_THROW(estimate(params, {{{{7, 40}, 3}}, {64, 64}, Tile::both}), Error);
  params.start = "start.png";
  EXPECT_THROW(check_settings(params), ConfigError);
}

}  // namespace
}  // namespace gramloom::neural
