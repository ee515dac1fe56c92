// What several processes do together is what one does alone. The processes are threads here, which
// meet and talk as processes do.
#include "neural/group.h"

#include <c10/core/GradMode.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "groups.h"
#include "networks.h"
#include "neural/loss/loss.h"
#include "neural/resample.h"
#include "neural/shared_rows.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

TEST(Group, OneProcessSaysNothing) {
  std::vector<float> values{1, -2};
  one_process().sum(std::span(values));
  one_process().largest(std::span(values));
  one_process().first(std::span(values));
  EXPECT_EQ(values, (std::vector<float>{1, -2}));
  EXPECT_TRUE(one_process().any(true));
  EXPECT_FALSE(one_process().any(false));
  EXPECT_EQ(one_process().bytes_sent(), 0);
}

TEST(Group, SumsAndLargestAreThoseOfAll) {
  together(3, [](const Group& group) {
    const auto own = static_cast<float>(group.rank() + 1);
    std::vector<float> sums{own, -own}, largest = sums, first = sums;
    group.sum(std::span(sums));
    group.largest(std::span(largest));
    group.first(std::span(first));
    EXPECT_EQ(sums, (std::vector<float>{6, -6}));
    EXPECT_EQ(largest, (std::vector<float>{3, -1}));
    EXPECT_EQ(first, (std::vector<float>{1, -1}));
    EXPECT_TRUE(group.any(group.rank() == 2));
    EXPECT_FALSE(group.any(false));
    EXPECT_GT(group.bytes_sent(), 0);
  });
}

TEST(Group, OneThatIsGoneIsNoticed) {
  EXPECT_THROW(together(2,
                        [](const Group& group) {
                          if (group.rank() == 1) return;
                          std::vector<float> values(1000);
                          for (int i = 0; i < 10; ++i) group.sum(std::span(values));
                        }),
               GroupLost);
}

// Rows that go around the circle, beyond the neighbours and over all there are.
std::vector<Rows> wishes(int rank) {
  return {{-3, 4}, {5 * rank - 2, 5 * rank + 9}, {0, 17}, {16, 20}, {-17, 34}};
}

TEST(RowExchange, TakesTheRowsOfWhoeverHasThem) {
  const std::int64_t height = 17;
  const at::Tensor whole = numbers({2, height, 3}, 1);
  for (const int size : {2, 3, 5})
    together(size, [&](const Group& group) {
      const Rows own = own_rows(group, height);
      const at::Tensor mine = whole.narrow(1, own.begin, own.count());
      for (const Rows wanted : wishes(group.rank())) {
        const HeldRows taken =
            RowExchange(group, height, wanted).take(held_by(group, mine, height));
        EXPECT_EQ(taken.rows, wanted);
        for (std::int64_t row = wanted.begin; row < wanted.end; ++row)
          EXPECT_TRUE(at::equal(taken.data.select(1, row - wanted.begin),
                                whole.select(1, source_of(row, height, Padding::circular))));
      }
    });
}

// ⟨take(x), y⟩ = ⟨x, give_back(y)⟩.
TEST(RowExchange, GivingBackIsTheTranspose) {
  const std::int64_t height = 17;
  for (const int size : {1, 2, 3})
    together(size, [&](const Group& group) {
      const at::Tensor mine = numbers({2, own_rows(group, height).count(), 3},
                                      static_cast<std::uint64_t>(group.rank()), at::kDouble);
      for (const Rows wanted : wishes(group.rank())) {
        const RowExchange exchange(group, height, wanted);
        const HeldRows taken = exchange.take(held_by(group, mine, height));
        const at::Tensor of_taken =
            numbers(taken.data.sizes(), static_cast<std::uint64_t>(10 + group.rank()), at::kDouble);
        const double there = sum_of(group, (taken.data * of_taken).sum().item<double>());
        const double back =
            sum_of(group, (mine * exchange.give_back(of_taken)).sum().item<double>());
        EXPECT_NEAR(there, back, 1e-12);
      }
    });
}

TEST(Resample, RowsBeyondTheEdgesAreTheSameBits) {
  const at::Tensor picture = numbers({2, 9, 8}, 1);
  const Size size{11, 14};
  const at::Tensor whole = resample(picture, size, Tile::both);
  const HeldRows beyond = resample(all_rows(picture), size, {-3, 20}, Tile::both);
  for (std::int64_t row = -3; row < 20; ++row)
    EXPECT_TRUE(at::equal(beyond.data.select(1, row + 3),
                          whole.select(1, source_of(row, 14, Padding::circular))));
}

// A loss and its gradient.
struct Found {
  double value = 0;
  std::vector<Term> terms;
  at::Tensor gradient;
};

struct GroupCase {
  NeuralParams params;
  Padding padding;
  Tile tile;
  NetworkDescription network;
};

Found found(const GroupCase& c, const at::Tensor& whole, const Group& group) {
  const Network network = random_network(c.network, at::kFloat);
  const MatchedNetwork matched{network, c.network, {{1, 1}, {3, 0.5}}};
  const Edges edges{tiles_x(c.tile) ? Padding::circular : c.padding,
                    tiles_y(c.tile) ? Padding::circular : c.padding};
  const at::Tensor exemplar = numbers({2, 40, 30}, 1).cumsum(2) * 0.2;
  Loss loss(c.params, &matched, exemplar, {Padding::reflect, Padding::reflect},
            {size_of(whole), c.tile}, edges, Random(5), nullptr, {}, group);
  const Rows own = own_rows(group, whole.size(1));
  const at::Tensor mine = whole.narrow(1, own.begin, own.count()).contiguous();
  Found result{0, {}, at::empty_like(mine)};
  result.value = loss(mine, 3, result.gradient);
  result.terms = loss.terms();
  return result;
}

NetworkDescription pooled_network() {
  NetworkDescription network;
  network.name = "pooled";
  network.layers = {{"conv1", ConvolutionLayer{5, 3, 1}},
                    {"relu1", ReluLayer{}},
                    {"pool1", AveragePoolLayer{}},
                    {"conv2", ConvolutionLayer{4, 5, 1}}};
  return network;
}

std::vector<GroupCase> group_cases() {
  NeuralParams grams;
  grams.sliced_weight = grams.spectrum_weight = 0;
  grams.gram_weight = 1;
  NeuralParams shifted = grams, sliced, both = grams;
  shifted.shifts = {1, 3};
  sliced.spectrum_weight = 0;
  sliced.patch_sizes = {7, 5};
  sliced.directions = 6;
  sliced.positions = 4096;
  both.sliced_weight = 0.5;
  both.positions = 4096;
  both.directions = 3;
  std::vector<GroupCase> all;
  for (const Tile tile : {Tile::none, Tile::both})
    for (const NeuralParams& params : {shifted, sliced})
      all.push_back({params, Padding::circular, tile, pyramid_network()});
  all.push_back({grams, Padding::reflect, Tile::none, pyramid_network()});
  all.push_back({shifted, Padding::zero, Tile::none, pyramid_network()});
  all.push_back({grams, Padding::valid, Tile::x, pooled_network()});
  all.push_back({shifted, Padding::circular, Tile::y, pooled_network()});
  all.push_back({both, Padding::reflect, Tile::x, pooled_network()});
  return all;
}

TEST(SharedLoss, IsThatOfOneProcess) {
  const at::Tensor picture = numbers({2, 131, 50}, 2).cumsum(1) * 0.3;
  const std::vector<GroupCase> all = group_cases();
  std::vector<Found> alone;
  for (const GroupCase& c : all) alone.push_back(found(c, picture, one_process()));
  together(3, [&](const Group& group) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Found shared = found(all[i], picture, group);
      EXPECT_NEAR(shared.value, alone[i].value, 1e-5 * alone[i].value) << i;
      ASSERT_EQ(shared.terms.size(), alone[i].terms.size());
      const Rows own = own_rows(group, picture.size(1));
      EXPECT_LT(
          relative_difference(shared.gradient, alone[i].gradient.narrow(1, own.begin, own.count())),
          2e-5)
          << "case " << i << ", rows from " << own.begin << " on";
    }
  });
}

// Patches are compared by the same sample and the same counts: not even rounding differs.
TEST(SharedLoss, OfPatchesIsTheSameNumber) {
  const at::Tensor picture = numbers({2, 131, 50}, 2).cumsum(1) * 0.3;
  for (const GroupCase& c : group_cases()) {
    if (c.params.gram_weight > 0) continue;
    const double alone = found(c, picture, one_process()).value;
    EXPECT_GT(alone, 0);
    together(2, [&](const Group& group) { EXPECT_EQ(found(c, picture, group).value, alone); });
  }
}

}  // namespace
}  // namespace gramloom::neural
