#include "classic/overlap_weighted.h"

#include <gtest/gtest.h>

#include "patch_exemplars.h"

namespace gramloom {
namespace {

TEST(WeightedErrors, AreTheSumsOfTheDefinition) {
  // Of one block, of several, of even and odd lengths, and of one row or column.
  for (const auto& [size, patch] : {std::pair{Size{61, 47}, Size{9, 12}},
                                    {Size{700, 20}, Size{5, 20}},
                                    {Size{17, 900}, Size{16, 3}},
                                    {Size{40, 1}, Size{7, 1}},
                                    {Size{1, 30}, Size{1, 30}}}) {
    const Image exemplar = blobs(size.width, size.height, 3, 1);
    const Image fresh = blobs(patch.width, patch.height, 3, 2);
    Random random(3);
    std::vector<float> weights;
    for (int i = 0; i < patch.width * patch.height; ++i)
      weights.push_back(std::max(0.0f, random.uniform(-0.5f, 4)));
    const WeightedErrors errors(exemplar, patch);
    const Size positions = errors.positions();
    ASSERT_EQ(positions, (Size{size.width - patch.width + 1, size.height - patch.height + 1}));
    std::vector<float> found(static_cast<std::size_t>(positions.width * positions.height), 5.0f);
    errors.add_to(found, fresh, weights, 2);
    for (int v = 0; v < positions.height; v += 3)
      for (int u = 0; u < positions.width; u += 5) {
        double wanted = 0;
        for (int y = 0; y < patch.height; ++y)
          for (int x = 0; x < patch.width; ++x)
            for (int c = 0; c < 3; ++c)
              wanted +=
                  double{weights[static_cast<std::size_t>(y * patch.width + x)]} *
                  std::pow(double{exemplar.at(u + x, v + y)[c]} - double{fresh.at(x, y)[c]}, 2);
        ASSERT_NEAR(found[static_cast<std::size_t>(v * positions.width + u)], 5 + 2 * wanted,
                    1e-4 * (1 + wanted))
            << u << ' ' << v;
      }
  }
}

}  // namespace
}  // namespace gramloom
