#include "neural/checkpoint.h"

#include <gtest/gtest.h>

#include "core/fields.h"

namespace gramloom::neural {
namespace {

namespace fs = std::filesystem;

TEST(Checkpoint, KeepsEveryNumberExactly) {
  using Limits = std::numeric_limits<double>;
  const fs::path file = fs::path(testing::TempDir()) / "numbers.checkpoint";
  Checkpoint written;
  written.identity = "f";
  written.iteration = (std::int64_t{1} << 53) - 1;
  written.first_level = 4;
  written.first_loss = 1.0 / 3;
  written.picture = at::zeros({1, 2, 3});
  // As inverse_sy can be near the end, or the loss of an unnormalised layer.
  written.optimiser.numbers = {{"tiny", 1e-40 / 3},      {"huge", 1e60 / 3},
                               {"least", Limits::min()}, {"most", Limits::max()},
                               {"negative", -0.1},       {"zero", 0}};
  write_checkpoint(file, written);
  const auto read = read_checkpoint(file, "f");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->iteration, written.iteration);
  EXPECT_EQ(read->first_level, written.first_level);
  EXPECT_EQ(read->first_loss, written.first_loss);
  EXPECT_EQ(read->optimiser.numbers, written.optimiser.numbers);
  EXPECT_FALSE(read_checkpoint(file, "g"));
  fs::remove(file);
}

}  // namespace
}  // namespace gramloom::neural
