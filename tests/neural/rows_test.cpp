// A picture looked at a few rows at a time has the same maps, statistics and gradients as a whole
// one.
#include "neural/network/rows.h"

#include <gtest/gtest.h>

#include "feature_terms.h"
#include "networks.h"
#include "neural/resample.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

constexpr auto paddings =
    std::to_array({Padding::circular, Padding::reflect, Padding::zero, Padding::valid});

NetworkDescription deep() {
  NetworkDescription network;
  network.name = "deep";
  network.layers = {{"conv1", ConvolutionLayer{20, 3, 1}},  // more than a block of channels
                    {"relu1", ReluLayer{}},
                    {"pool1", AveragePoolLayer{}},
                    {"bank2", BankLayer{17, {1, 3, 5}, {1, 1, 2}, {0, 0, 0.6}}},
                    {"relu2", ReluLayer{}},
                    {"pool2", MaxPoolLayer{}},
                    {"conv3", ConvolutionLayer{5, 3, 1}}};
  return network;
}

NetworkDescription bank() {
  NetworkDescription network;
  network.name = "bank";
  network.layers = {{"bank1", BankLayer{4, {3, 7}, {1, 1}, {0, 1.2}}}, {"relu1", ReluLayer{}}};
  return network;
}

TEST(TakeRows, GoOnBeyondTheEdges) {
  const at::Tensor rows = at::arange(4, at::kDouble).view({1, 4, 1});
  const auto taken = [&](Rows wanted, Padding padding) {
    const at::Tensor t = take_rows(all_rows(rows), wanted, padding).flatten();
    return std::vector<double>(t.data_ptr<double>(), t.data_ptr<double>() + t.numel());
  };
  EXPECT_EQ(taken({-2, 6}, Padding::circular), (std::vector<double>{2, 3, 0, 1, 2, 3, 0, 1}));
  EXPECT_EQ(taken({-2, 6}, Padding::reflect), (std::vector<double>{1, 0, 0, 1, 2, 3, 3, 2}));
  EXPECT_EQ(taken({-2, 6}, Padding::zero), (std::vector<double>{0, 0, 0, 1, 2, 3, 0, 0}));
}

TEST(TakeRows, SeeTheSameFromWhatTheyAreMadeOf) {
  const at::Tensor whole = numbers({2, 9, 3}, 1, at::kDouble);
  for (const auto padding : {Padding::circular, Padding::reflect, Padding::zero})
    for (std::int64_t begin = -7; begin < 14; ++begin)
      for (std::int64_t end = begin + 1; end < 16; ++end) {
        if (end <= 0 || begin >= 9) continue;  // all of them beyond: nothing asks for that
        const Rows wanted{begin, end}, behind = rows_behind(wanted, 9, padding);
        const HeldRows some{take_rows(all_rows(whole), behind, padding), 2, behind, 9};
        EXPECT_TRUE(at::equal(take_rows(some, wanted, padding),
                              take_rows(all_rows(whole), wanted, padding)))
            << to_word(padding) << " " << begin << " " << end;
      }
}

// Any rows of any layer, at odd sizes, are those of the whole picture's maps.
TEST(Rows, HaveTheRowsOfTheWhole) {
  for (const auto& description : {deep(), bank(), pyramid_network()})
    for (const auto padding : paddings) {
      if (padding == Padding::valid && description.name == "pyramid") continue;
      const Edges edges{Padding::circular, padding};
      const Network network = random_network(description, at::kDouble);
      const at::Tensor picture = numbers({2, 47, 22}, 1, at::kDouble);
      std::vector<std::size_t> all(description.layers.size());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
      const auto maps = network(picture, edges, all);
      const auto scales = network.scales(picture, edges);
      for (std::size_t k = 0; k < scales.size(); ++k)
        for (std::int64_t share = 0; share < 4; ++share) {
          std::vector<Rows> rows;
          for (const std::size_t layer : all) {
            rows.push_back(share_of(maps[layer][k].height(), share, 4));
            if (padding == Padding::circular) rows.back().begin -= 1;  // also across the edge
          }
          const Rows behind = network.rows_of_scale(size_of(scales[k]), edges, all, rows);
          const HeldRows whole = all_rows(scales[k]);
          const auto some = network.maps_of_rows(
              k, {take_rows(whole, behind, padding), 2, behind, whole.height}, edges, all, rows);
          for (const std::size_t layer : all) {
            const auto& own = maps[layer][k];
            const at::Tensor expected =
                take_rows({own.data, own.channels, {0, own.height()}, own.height()}, rows[layer],
                          Padding::circular);
            EXPECT_LT(relative_difference(some[layer].data, expected), 1e-12)
                << description.name << " " << to_word(padding) << " layer " << layer << " scale "
                << k << " share " << share;
          }
        }
    }
}

TEST(Rows, ShrinkToTheRowsOfTheWhole) {
  for (const auto tile : {Tile::none, Tile::both}) {
    const at::Tensor data = numbers({1, 23, 10, 4}, 2, at::kDouble);
    const HeldRows whole{data, 4, {0, 23}, 23};
    const at::Tensor all = shrink(whole, {5, 12}, {0, 12}, tile).data;
    for (std::int64_t begin = 0; begin < 12; ++begin)
      for (std::int64_t end = begin + 1; end <= 12; ++end) {
        const Rows behind = rows_to_shrink({begin, end}, 23, 12, tile);
        const HeldRows some{take_rows(whole, behind, Padding::circular), 4, behind, 23};
        EXPECT_LT(relative_difference(shrink(some, {5, 12}, {begin, end}, tile).data,
                                      all.narrow(1, begin, end - begin)),
                  1e-12);
      }
  }
}

NeuralParams matched(double gram, double sliced, std::vector<int> shifts) {
  NeuralParams params = with_preset(Preset::gatys);
  params.gram_weight = gram;
  params.sliced_features_weight = sliced;
  params.shifts = std::move(shifts);
  params.directions = 6;
  return params;
}

struct Evaluated {
  std::vector<Term> terms;
  at::Tensor gradient;
};
Evaluated evaluate(const NetworkDescription& description, const NeuralParams& params,
                   const at::Tensor& exemplar, const at::Tensor& picture, Edges edges,
                   std::int64_t positions_at_once) {
  const Network network = random_network(description, picture.scalar_type());
  const std::size_t last = description.layers.size() - 1;
  Features terms({network, description, {{0, 1}, {last, 0.5}}}, feature_terms(params, exemplar),
                 exemplar, {Padding::reflect, Padding::reflect}, edges, positions_at_once);
  Evaluated result{{}, at::zeros_like(picture)};
  result.terms = terms.add(picture, 3, result.gradient);
  return result;
}

void expect_same(const Evaluated& a, const Evaluated& b, double tolerance) {
  ASSERT_EQ(a.terms.size(), b.terms.size());
  for (std::size_t i = 0; i < a.terms.size(); ++i) {
    EXPECT_EQ(a.terms[i].name, b.terms[i].name);
    EXPECT_NEAR(a.terms[i].value, b.terms[i].value, tolerance * b.terms[i].value);
  }
  EXPECT_LT(relative_difference(a.gradient, b.gradient), tolerance);
}

TEST(Features, OfAFewRowsAtATimeAreThoseOfTheWhole) {
  const at::Tensor exemplar = numbers({2, 33, 30}, 1, at::kDouble);
  const at::Tensor picture = numbers({2, 57, 46}, 2, at::kDouble);
  for (const auto& description : {deep(), bank(), pyramid_network()})
    for (const auto padding : paddings)
      for (const auto& shifts : {std::vector<int>{}, std::vector<int>{1, 3}}) {
        if (padding == Padding::valid && description.name == "pyramid") continue;
        const auto of = [&](std::int64_t positions_at_once) {
          return evaluate(description, matched(1, 0, shifts), exemplar, picture, {padding, padding},
                          positions_at_once);
        };
        const auto whole = of(1 << 20);
        EXPECT_GT(whole.gradient.abs().max().item<double>(), 0);
        for (const std::int64_t rows : {20, 7, 1}) expect_same(of(rows * 46), whole, 1e-10);
      }
}

// In float, and with the values that are sorted.
TEST(Features, OfAFewRowsAtATimeAreThoseOfTheWholeToFloatPrecision) {
  const at::Tensor exemplar = numbers({2, 33, 30}, 1), picture = numbers({2, 57, 46}, 2);
  for (const auto& description : {deep(), bank(), pyramid_network()})
    for (const auto padding : paddings) {
      if (padding == Padding::valid && description.name == "pyramid") continue;
      const auto of = [&](std::int64_t positions_at_once) {
        return evaluate(description, matched(0.7, 0.3, {2}), exemplar, picture, {padding, padding},
                        positions_at_once);
      };
      const auto whole = of(1 << 20);
      EXPECT_EQ(whole.terms.size(), 4u);
      expect_same(of(7 * 46), whole, 2e-5);
    }
}

// Float maps, which oneDNN makes, of a picture in one piece are those of LibTorch in double.
TEST(Rows, InFloatAreThoseInDouble) {
  const at::Tensor picture = numbers({2, 57, 46}, 2);
  for (const auto& description : {deep(), bank()})
    for (const auto padding : paddings) {
      const Edges edges{padding, padding};
      const std::vector<std::size_t> last{description.layers.size() - 1};
      const auto as_float = random_network(description, at::kFloat)(picture, edges, last)[0][0];
      const auto as_double =
          random_network(description, at::kDouble)(picture.to(at::kDouble), edges, last)[0][0];
      EXPECT_LT(relative_difference(to_planes(as_float), to_planes(as_double)), 1e-5)
          << description.name << " " << to_word(padding);
    }
}

// Shifts that the picture is large enough for and the exemplar is not are left out.
TEST(Features, OfAnExemplarTooSmallForTheShifts) {
  const at::Tensor exemplar = numbers({2, 16, 16}, 1, at::kDouble);
  const at::Tensor picture = numbers({2, 40, 40}, 2, at::kDouble);
  const auto of = [&](std::int64_t positions_at_once) {
    return evaluate(pyramid_network(), matched(1, 0, {3}), exemplar, picture,
                    {Padding::circular, Padding::circular}, positions_at_once);
  };
  const auto whole = of(1 << 20);
  EXPECT_GT(whole.terms[0].value, 0);
  expect_same(of(200), whole, 1e-10);
}

}  // namespace
}  // namespace gramloom::neural
