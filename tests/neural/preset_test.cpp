// Each preset on small pictures of one, three and five channels, and what its defaults promise.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/field_values.h"
#include "neural/settings.h"
#include "neural/synthesis.h"

namespace gramloom {
namespace {

// Bricks of two colours in rows that are shifted by half a brick, with some grain.
Image bricks(Size size, int channels) {
  Image image(size, channels);
  Random random(1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const bool joint = y % 12 < 2 || (x + y / 12 % 2 * 12) % 24 < 2;
      for (int c = 0; c < channels; ++c)
        image.at(x, y)[c] =
            (joint ? 0.2f + 0.1f * static_cast<float>(c) : 0.7f) + 0.1f * random.uniform();
    }
  return image;
}

// With a few of its steps.
NeuralParams shortened(Preset preset) {
  NeuralParams params = with_preset(preset);
  for (int& steps : params.iterations) steps = std::clamp(steps / 10, 8, 16);
  if (preset == Preset::gatys) params.iterations = {5};  // seconds each
  return params;
}

struct PresetCase {
  Preset preset;
  int channels;
  Tile tile;
};

class EveryPreset : public testing::TestWithParam<PresetCase> {};

TEST_P(EveryPreset, LowersItsLoss) {
  const auto [preset, channels, tile] = GetParam();
  NeuralParams params = shortened(preset);
  const Image exemplar = bricks({96, 96}, channels);
  params.layout = neural::layout_by_size(params, exemplar.size(), {{96, 96}, tile});
  std::vector<Progress> steps;
  const Control control{[&](const Progress& p) {
                          if (p.loss == p.loss) steps.push_back(p);  // a layout has none
                          return true;
                        },
                        {},
                        {}};
  const Image result =
      synthesise(params, {{{exemplar}}, {{96, 96}, tile}, Random(3)}, control).image;
  EXPECT_EQ(result.size(), (Size{96, 96}));
  EXPECT_EQ(result.channels, channels);
  const int levels = neural::level_count(params, exemplar.size(), {{96, 96}, tile});
  ASSERT_EQ(steps.back().step, neural::steps_down_to(params, levels, 0));
  params.flow_steps = {0};  // from here on: steps with a loss
  ASSERT_EQ(static_cast<std::int64_t>(steps.size()), neural::steps_down_to(params, levels, 0));
  // Steps of one level have one loss, but for its random directions.
  const auto mean = [&](auto first, auto last) {
    return std::accumulate(first, last, 0.0,
                           [](double sum, const auto& p) { return sum + p.loss; }) /
           static_cast<double>(last - first);
  };
  for (int level = 0; level < levels; ++level) {
    const auto begin = steps.begin() + neural::steps_down_to(params, levels, level + 1);
    const auto end = steps.begin() + neural::steps_down_to(params, levels, level);
    const auto quarter = std::max<std::ptrdiff_t>(1, (end - begin) / 4);
    EXPECT_LT(mean(end - quarter, end), mean(begin, begin + quarter)) << "on level " << level;
  }
}

std::vector<PresetCase> every_preset() {
  std::vector<PresetCase> cases;
  for (const Preset preset : {Preset::fast, Preset::balanced, Preset::quality, Preset::gatys})
    for (const int channels : {1, 3, 5})
      for (const Tile tile : {Tile::none, Tile::both}) cases.push_back({preset, channels, tile});
  return cases;
}

std::string name_of(const testing::TestParamInfo<PresetCase>& info) {
  return fmt::format("{}_{}_{}", to_word(info.param.preset), info.param.channels,
                     to_word(info.param.tile));
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryPreset, testing::ValuesIn(every_preset()), name_of);

TEST(Presets, AreAllAllowedAndTheirDefaultIsBalanced) {
  for (const Preset preset : {Preset::fast, Preset::balanced, Preset::quality, Preset::gatys}) {
    const NeuralParams params = with_preset(preset);
    EXPECT_EQ(params.preset, preset);
    EXPECT_NO_THROW(neural::check_settings(params));
  }
  EXPECT_EQ(NeuralParams{}.preset, Preset::balanced);
  EXPECT_EQ(with_preset(Preset::balanced).iterations, NeuralParams{}.iterations);
}

TEST(Presets, AConstantExemplarGivesAConstantImage) {
  for (const Preset preset : {Preset::fast, Preset::balanced, Preset::quality})
    for (const Tile tile : {Tile::none, Tile::both}) {
      const Image flat({48, 40}, 3, 0.3f);
      const Image result =
          synthesise(shortened(preset), {{{flat}}, {{52, 40}, tile}, Random(1)}, {}).image;
      for (const float value : result.pixels) ASSERT_EQ(value, 0.3f);
    }
}

// The part of all squares of 2 × 2 pixels on the torus that are of a checkerboard, of either phase.
double part_of_checkerboards(const Image& image) {
  const auto white = [&](int x, int y) {
    return *image.at(x % image.width, y % image.height) > 0.5f;
  };
  int boards = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      boards += white(x, y) != white(x + 1, y) && white(x, y) != white(x, y + 1) &&
                white(x, y) == white(x + 1, y + 1);
  return boards / static_cast<double>(image.pixels.size());
}

// Patches alone begin both phases, in places apart, that meet along lines; the spectrum joins them.
TEST(Presets, ACheckerboardOfPixelsComesBack) {
  Image board({64, 64}, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) *board.at(x, y) = static_cast<float>((x + y) % 2);
  for (const std::uint64_t seed : {1u, 2u}) {
    const Image result = synthesise(with_preset(Preset::balanced),
                                    {{{board}}, {{64, 64}, Tile::both}, Random(seed)}, {})
                             .image;
    EXPECT_GT(part_of_checkerboards(result), 0.98) << "seed " << seed;
  }
}

// Two channels of one surface, the second the negative of the first: still so in the result.
TEST(Presets, MapsStayRegistered) {
  Image exemplar = bricks({96, 96}, 2);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) exemplar.at(x, y)[1] = 1 - exemplar.at(x, y)[0];
  const Image result =
      synthesise(shortened(Preset::balanced), {{{exemplar}}, {{96, 96}, Tile::both}, Random(1)}, {})
          .image;
  double difference = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      difference += std::abs(result.at(x, y)[0] + result.at(x, y)[1] - 1) / (96.0 * 96);
  EXPECT_LT(difference, 0.01);
}

}  // namespace
}  // namespace gramloom
