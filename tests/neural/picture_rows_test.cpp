// Rows of a picture that are seen a share at a time add up to the whole, however they are shared.
#include "neural/loss/picture_rows.h"

#include <c10/core/GradMode.h>
#include <gtest/gtest.h>
#include <torch/csrc/autograd/autograd.h>

#include "networks.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

constexpr std::int64_t height = 23, width = 18;
const std::vector<std::size_t> wanted{1, 3};

NetworkDescription two_layers() {
  NetworkDescription network;
  network.name = "two layers";
  network.layers = {{"conv1", ConvolutionLayer{5, 3, 1}},
                    {"relu1", ReluLayer{}},
                    {"pool1", AveragePoolLayer{}},
                    {"conv2", ConvolutionLayer{4, 5, 1}}};
  return network;
}

std::vector<Rows> own_alone(const std::vector<Size>&, const std::vector<Rows>& own) { return own; }
// And a row above and below, across the edges.
std::vector<Rows> with_neighbours(const std::vector<Size>&, const std::vector<Rows>& own) {
  std::vector<Rows> result;
  for (const Rows& rows : own) result.push_back({rows.begin - 1, rows.end + 1});
  return result;
}

PictureRows rows_of(const Network& network, const at::Tensor& picture, Edges edges,
                    std::int64_t at_once, RowsNeeded needed = own_alone) {
  return {network, wanted, all_rows(picture), edges, std::move(needed), at_once * width};
}

std::vector<std::int64_t> all_splits() {
  std::vector<std::int64_t> at_once;
  for (std::int64_t rows = 1; rows <= height; ++rows) at_once.push_back(rows);
  return at_once;
}

TEST(PictureRows, OwnRowsAreAllRowsOnce) {
  for (const auto& description : {two_layers(), pyramid_network()}) {
    const Network network = random_network(description, at::kDouble);
    for (const std::int64_t at_once : all_splits()) {
      const PictureRows rows =
          rows_of(network, numbers({2, height, width}, 1, at::kDouble), Edges{}, at_once);
      EXPECT_LE(rows.shares(), height);
      std::vector<std::vector<std::int64_t>> next;  // by layer and scale
      for (std::int64_t share = 0; share < rows.shares(); ++share) {
        const SeenRows seen = rows.see(share);
        ASSERT_EQ(seen.own.size(), wanted.size());
        next.resize(wanted.size());
        for (std::size_t l = 0; l < wanted.size(); ++l) {
          next[l].resize(seen.own[l].size(), 0);
          for (std::size_t k = 0; k < seen.own[l].size(); ++k) {
            EXPECT_EQ(seen.own[l][k].begin, next[l][k]);
            EXPECT_FALSE(seen.own[l][k].empty());
            next[l][k] = seen.own[l][k].end;
          }
        }
      }
      const SeenRows whole =
          rows_of(network, numbers({2, height, width}, 1, at::kDouble), Edges{}, height).see(0);
      for (std::size_t l = 0; l < wanted.size(); ++l)
        for (std::size_t k = 0; k < next[l].size(); ++k) EXPECT_EQ(next[l][k], whole.own[l][k].end);
    }
  }
}

TEST(PictureRows, MapsOfTheSharesAreThoseOfTheWhole) {
  const at::Tensor picture = numbers({2, height, width}, 1, at::kDouble);
  for (const auto& description : {two_layers(), pyramid_network()})
    for (const auto padding : {Padding::circular, Padding::reflect, Padding::zero}) {
      const Network network = random_network(description, at::kDouble);
      const Edges edges{padding, padding};
      const auto whole = network(picture, edges, wanted);
      for (const std::int64_t at_once : all_splits()) {
        const PictureRows rows = rows_of(network, picture, edges, at_once);
        for (std::size_t l = 0; l < wanted.size(); ++l)
          for (std::size_t k = 0; k < whole[l].size(); ++k) {
            std::vector<at::Tensor> found;
            for (std::int64_t share = 0; share < rows.shares(); ++share) {
              const SeenRows seen = rows.see(share);
              found.push_back(take_rows(seen.maps[l][k], seen.own[l][k], padding));
            }
            EXPECT_LT(relative_difference(at::cat(found, 1), whole[l][k].data), 1e-12)
                << description.name << " " << to_word(padding) << " layer " << wanted[l]
                << " scale " << k << ", " << at_once << " rows at once";
          }
      }
    }
}

// Of Σ sin(all maps): what the shares give adds up, through scales and edges.
TEST(PictureRows, GradientsOfTheSharesAddUp) {
  const c10::AutoGradMode gradients(true);
  const at::Tensor picture = numbers({2, height, width}, 1, at::kDouble);
  const auto gradient_of = [&](const PictureRows& rows) {
    std::vector<at::Tensor> of_scales = rows.zeros();
    for (std::int64_t share = 0; share < rows.shares(); ++share) {
      const SeenRows seen = rows.see(share);
      at::Tensor sum = at::zeros({}, at::kDouble);
      for (std::size_t l = 0; l < wanted.size(); ++l)
        for (std::size_t k = 0; k < seen.maps[l].size(); ++k)
          sum = sum + take_rows(seen.maps[l][k], seen.own[l][k], Padding::circular).sin().sum();
      rows.add(seen, torch::autograd::grad({sum}, seen.inputs), of_scales);
    }
    return rows.of_picture(of_scales);
  };
  for (const auto& description : {two_layers(), pyramid_network()})
    for (const auto padding : {Padding::circular, Padding::reflect, Padding::zero}) {
      const Network network = random_network(description, at::kDouble);
      const Edges edges{padding, padding};
      const at::Tensor whole = gradient_of(rows_of(network, picture, edges, height));
      EXPECT_GT(whole.abs().max().item<double>(), 0);
      for (const std::int64_t at_once : all_splits())
        for (const auto& needed : {own_alone, with_neighbours}) {
          if (needed == with_neighbours && padding != Padding::circular) continue;
          EXPECT_LT(relative_difference(
                        gradient_of(rows_of(network, picture, edges, at_once, needed)), whole),
                    1e-12)
              << description.name << " " << to_word(padding) << ", " << at_once << " rows at once";
        }
      // Against finite differences of the whole.
      const at::Tensor direction = numbers(picture.sizes(), 5, at::kDouble);
      const auto value = [&](const at::Tensor& x) {
        const c10::NoGradGuard no_gradients;
        double sum = 0;
        for (const auto& scales : network(x, edges, wanted))
          for (const auto& maps : scales) sum += maps.data.sin().sum().item<double>();
        return sum;
      };
      const double h = 1e-6;
      EXPECT_NEAR((whole * direction).sum().item<double>(),
                  (value(picture + h * direction) - value(picture - h * direction)) / (2 * h),
                  1e-5 * whole.norm().item<double>() * direction.norm().item<double>());
    }
}

TEST(PictureRows, AtLeastARowOfTheSmallestMapsAtOnce) {
  const Network network = random_network(pyramid_network(), at::kDouble);
  const at::Tensor picture = numbers({2, height, width}, 1, at::kDouble);
  EXPECT_EQ(rows_of(network, picture, Edges{}, height).shares(), 1);
  EXPECT_EQ(rows_of(network, picture, Edges{}, 12).shares(), 2);
  EXPECT_EQ(rows_of(network, picture, Edges{}, 1).shares(), 6);  // heights are 23, 12, 6
}

}  // namespace
}  // namespace gramloom::neural
