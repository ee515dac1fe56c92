// A texture that several processes make is that of one.
#include "neural/shared_synthesis.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "groups.h"
#include "io/text_file.h"
#include "syntheses.h"

namespace gramloom {
namespace {

// A network of few filters on two sizes of the picture.
struct SmallNetwork {
  SmallNetwork() {
    write_text(file,
               "name = 'small'\nsummary = 'small'\nmatched = ['relu1']\n"
               "[[layer]]\nname = 'pyramid1'\ntype = 'pyramid'\nchannels = 8\nscales = 2\n"
               "[[layer]]\nname = 'relu1'\ntype = 'relu'\n");
  }
  ~SmallNetwork() { std::filesystem::remove(file); }
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("gramloom_shared_{}.toml", getpid());
};

NeuralParams quick_grams() {
  NeuralParams params;
  params.layout = Layout::noise;
  params.sliced_weight = params.spectrum_weight = 0;
  params.gram_weight = 1;
  static const SmallNetwork network;
  params.network = network.file;
  params.positions = 4096;
  params.levels = 2;
  params.iterations = {3, 3};
  return params;
}

NeuralParams quick_sliced() {
  NeuralParams params;
  params.layout = Layout::noise;
  params.spectrum_weight = 0;
  params.patch_sizes = {5, 3};
  params.directions = 6;
  params.positions = 4096;
  params.levels = 3;
  params.level_factor = 0.8;
  params.iterations = {4, 4, 4};
  return params;
}

struct Case {
  NeuralParams params;
  Target target;
};

std::vector<Case> cases() {
  NeuralParams lbfgs = quick_grams();
  lbfgs.optimizer = {Optimizer::lbfgs};
  lbfgs.shifts = {2};
  return {{quick_grams(), {{40, 211}, Tile::both}},
          {lbfgs, {{40, 211}, Tile::x}},
          {quick_sliced(), {{60, 230}, Tile::none}},
          {quick_sliced(), {{60, 230}, Tile::both}}};
}

TEST(SharedSynthesis, IsThatOfOneProcess) {
  const Image exemplar = stripes({48, 44}, 3);
  const std::vector<Case> all = cases();
  for (const Case& c : all) {
    SCOPED_TRACE(fmt::format("case {}", &c - all.data()));
    const Image alone = run(c.params, exemplar, c.target);
    Image shared(c.target.size, 3);
    neural::together(2, [&](const neural::Group& group) {
      const Request request{{{exemplar}}, c.target, Random(1)};
      const Image rows = synthesise_rows(c.params, request, {}, group).image;
      const int first = c.target.size.height * group.rank() / group.size();
      ASSERT_EQ(rows.width, c.target.size.width);
      std::ranges::copy(rows.pixels, shared.at(0, first));
      EXPECT_GT(group.bytes_sent(), 0);
    });
    // Adam moves a value whose gradient is only rounding as far as any other: hence not the
    // largest.
    double sum = 0;
    for (std::size_t i = 0; i < alone.pixels.size(); ++i)
      sum += std::abs(alone.pixels[i] - shared.pixels[i]);
    EXPECT_LT(sum / static_cast<double>(alone.pixels.size()), 1e-4);
  }
}

TEST(SharedSynthesis, OneThatIsToldToStopStopsAll) {
  neural::together(2, [&](const neural::Group& group) {
    int steps = 0;
    Control control;
    control.progress = [&](const Progress&) { return ++steps < 2 || group.rank() == 0; };
    const Request request{{{stripes({48, 44}, 3)}}, {{40, 211}, Tile::both}, Random(1)};
    const Image rows = synthesise_rows(quick_grams(), request, control, group).image;
    EXPECT_EQ(steps, 2);
    EXPECT_GE(rows.height, 105);
  });
}

TEST(SharedSynthesis, WhatCannotBeSharedIsRefusedByName) {
  const RequestSize request{{{{48, 44}, 3}}, {40, 211}, Tile::both};
  const auto refusal = [&](auto&& change) {
    NeuralParams params = quick_grams();
    RequestSize asked = request;
    change(params, asked);
    try {
      neural::check_shared(params, asked, 2);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto refused = [&](const std::string& name, auto&& change) {
    EXPECT_NE(refusal(change).find(name), std::string::npos) << name << ": " << refusal(change);
  };
  EXPECT_EQ(refusal([](NeuralParams&, RequestSize&) {}), "");
  refused("spectrum_weight", [](NeuralParams& p, RequestSize&) { p.spectrum_weight = 1; });
  refused("autocorrelation_weight",
          [](NeuralParams& p, RequestSize&) { p.autocorrelation_weight = 1; });
  refused("sliced_features_weight",
          [](NeuralParams& p, RequestSize&) { p.sliced_features_weight = 1; });
  refused("variation_weight", [](NeuralParams& p, RequestSize&) { p.variation_weight = 1; });
  refused("match_histogram", [](NeuralParams& p, RequestSize&) { p.match_histogram = true; });
  refused("layout", [](NeuralParams& p, RequestSize&) { p.layout = Layout::flow; });
  refused("too small", [](NeuralParams& p, RequestSize&) { p.positions = 300'000; });
  refused("too small", [](NeuralParams&, RequestSize& r) { r.size.height = 120; });
  refused("a mask", [](NeuralParams&, RequestSize& r) { r.exemplars[0].mask = true; });
  refused("several exemplars",
          [](NeuralParams&, RequestSize& r) { r.exemplars.push_back(r.exemplars[0]); });
}

TEST(SharedSynthesis, NeedsAPartOfTheMemory) {
  const RequestSize request{{{{256, 256}, 3}}, {16384, 16384}, Tile::both};
  const double alone = estimate(quick_grams(), request).bytes;
  EXPECT_LT(estimate_share(quick_grams(), request, 4).bytes, 0.4 * alone);
}

}  // namespace
}  // namespace gramloom
