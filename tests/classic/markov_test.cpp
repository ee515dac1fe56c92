#include "classic/markov.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "classic/context_table.h"
#include "classic/palette.h"

namespace gramloom {
namespace {

/// Rows of a chain over three grey levels whose next depends on the last two.
constexpr double follows[3][3][3] = {{{.1, .6, .3}, {.7, .2, .1}, {.3, .3, .4}},
                                     {{.5, .1, .4}, {.2, .2, .6}, {.8, .1, .1}},
                                     {{.2, .7, .1}, {.1, .1, .8}, {.4, .5, .1}}};

Image second_order_chain(Size size, std::uint64_t seed) {
  Image image(size, 1);
  Random random(seed);
  for (int y = 0; y < size.height; ++y) {
    int a = 0, b = 1;
    for (int x = -20; x < size.width; ++x) {
      const double u = static_cast<double>(random.uniform());
      const double* p = follows[a][b];
      a = std::exchange(b, u < p[0] ? 0 : u < p[0] + p[1] ? 1 : 2);
      if (x >= 0) *image.at(x, y) = static_cast<float>(b) / 2;
    }
  }
  return image;
}

int level(const Image& image, int x, int y) {
  return static_cast<int>(std::lround(*image.at(x, y) * 2));
}

/// Shares of the words of `length` levels within rows.
std::vector<double> word_shares(const Image& image, int length) {
  std::vector<double> shares(static_cast<std::size_t>(std::pow(3, length)));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x + length <= image.width; ++x) {
      int word = 0;
      for (int k = 0; k < length; ++k) word = word * 3 + level(image, x + k, y);
      shares[static_cast<std::size_t>(word)] += 1.0 / (image.height * (image.width - length + 1));
    }
  return shares;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(Markov, OrderKKeepsTheStatisticsOfKPlusOneAndNotOfMore) {
  const Image exemplar = second_order_chain({200, 200}, 1);
  for (const int order : {0, 1, 2}) {
    MarkovParams params;
    params.order = order;
    const Image image =
        synthesise(params, {{{exemplar}}, Target{{300, 300}}, Random(2)}, Control{}).image;
    // Shares have a standard error of at most ½/√90000 here, √2 of it between independent words.
    const double error = 5 * 0.5 / 300;
    EXPECT_LT(largest_difference(word_shares(image, order + 1), word_shares(exemplar, order + 1)),
              error);
    if (order < 2) {
      EXPECT_GT(largest_difference(word_shares(image, order + 2), word_shares(exemplar, order + 2)),
                2 * error);
    }
  }
}

TEST(Markov, TheChainWrapsWhereItTiles) {
  const Image exemplar = second_order_chain({200, 200}, 3);
  MarkovParams params;
  params.order = 2;
  const Image image =
      synthesise(params, {{{exemplar}}, Target{{40, 4000}, Tile::x}, Random(4)}, Control{}).image;
  // The words of three levels that lie across the seam, as frequent as anywhere.
  std::vector<double> across(27);
  for (int y = 0; y < image.height; ++y)
    for (const int start : {38, 39}) {
      int word = 0;
      for (int k = 0; k < 3; ++k) word = word * 3 + level(image, (start + k) % 40, y);
      across[static_cast<std::size_t>(word)] += 1.0 / (2 * image.height);
    }
  EXPECT_LT(largest_difference(across, word_shares(exemplar, 3)), 5 * 0.5 / std::sqrt(8000.0));
}

TEST(Markov, CausalNeighbourhoodContinuesAChessboard) {
  Image exemplar(16, 16, 1);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) *exemplar.at(x, y) = static_cast<float>((x + y) % 2);
  MarkovParams params;
  params.neighbourhood = MarkovNeighbourhood::causal;
  params.order = 2;
  const Image image =
      synthesise(params, {{{exemplar}}, Target{{50, 40}}, Random(5)}, Control{}).image;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x + 1 < 50; ++x) ASSERT_NE(*image.at(x, y), *image.at(x + 1, y));
}

TEST(Markov, WritesTheExemplarsOwnColours) {
  Image exemplar(20, 20, 3);
  Random random(6);
  std::set<std::vector<float>> colours;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      for (int c = 0; c < 3; ++c) exemplar.at(x, y)[c] = random.uniform();
      colours.insert({exemplar.at(x, y), exemplar.at(x, y) + 3});
    }
  const Image image =
      synthesise(MarkovParams{}, {{{exemplar}}, Target{{30, 30}}, Random(7)}, Control{}).image;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 30; ++x)
      ASSERT_TRUE(colours.contains({image.at(x, y), image.at(x, y) + 3}));
}

TEST(Palette, OfFewColoursIsExact) {
  Image image(30, 30, 2);
  std::set<std::pair<float, float>> colours;
  for (int i = 0; i < 900; ++i) {
    image.at(i % 30, i / 30)[0] = 0.1f * static_cast<float>(i % 5);
    image.at(i % 30, i / 30)[1] = 0.3f * static_cast<float>(i % 3);
    colours.insert({image.at(i % 30, i / 30)[0], image.at(i % 30, i / 30)[1]});
  }
  const Palette palette = learn_palette(image, 64, Random(1));
  ASSERT_EQ(palette.size(), 15);
  for (int k = 0; k < 15; ++k)
    EXPECT_TRUE(colours.contains({palette.colours[static_cast<std::size_t>(2 * k)],
                                  palette.colours[static_cast<std::size_t>(2 * k + 1)]}));
}

TEST(Palette, FindsTheClustersAndNearestIsNearest) {
  Image image(100, 60, 1);
  Random random(8);
  for (float& v : image.pixels)
    v = static_cast<float>(random.below(3)) + 0.1f * random.uniform(-1, 1);
  const Palette palette = learn_palette(image, 3, Random(2));
  ASSERT_EQ(palette.size(), 3);
  std::vector<float> sorted = palette.colours;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sorted[k], static_cast<float>(k), 0.01);
  const auto nearest = nearest_colours(image, palette);
  for (std::size_t i = 0; i < nearest.size(); ++i)
    for (const float colour : palette.colours)
      ASSERT_LE(std::abs(image.pixels[i] - palette.colours[nearest[i]]),
                std::abs(image.pixels[i] - colour));
}

TEST(ContextTable, DrawsFromThePositionsOfTheLongestSeenContext) {
  // "abracadabra": after "ra" comes only c; after "xa" (x never before a) whatever follows a.
  const std::string text = "abracadabra";
  std::vector<std::uint8_t> symbols;
  for (const char c : text) symbols.push_back(static_cast<std::uint8_t>(c - 'a'));
  const ContextTable table(symbols, {11, 1}, {{-1, 0}, {-2, 0}});
  const auto next_after = [&](int before, int last) {
    std::map<char, int> seen;
    Random random(9);
    for (int i = 0; i < 300; ++i) {
      const auto position =
          table.draw([&](Offset offset) { return offset.x == -1 ? last : before; }, random);
      ++seen[text[position]];
    }
    return seen;
  };
  const auto symbol = [](char c) { return c - 'a'; };
  EXPECT_EQ(next_after(symbol('r'), symbol('a')), (std::map<char, int>{{'c', 300}}));
  auto after_a = next_after(symbol('x'), symbol('a'));  // b, c, d, b
  EXPECT_EQ(after_a.size(), 3u);
  EXPECT_NEAR(after_a['b'], 150, 45);
  EXPECT_EQ(next_after(0, ContextTable::unknown).size(), 5u);
}

}  // namespace
}  // namespace gramloom
