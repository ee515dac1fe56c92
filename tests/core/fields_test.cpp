#include "core/fields.h"

#include <gtest/gtest.h>

namespace gramloom {

enum class Shade { light, dark };
template <>
inline constexpr auto enum_names<Shade> = std::to_array<std::string_view>({"light", "dark"});

namespace {

struct ExampleParams {
  int count = 3;
  double gain = 0.5;
  std::vector<double> weights{1};
  Shade shade = Shade::dark;

  static constexpr auto fields() {
    return std::tuple{
        Field{"count", &ExampleParams::count, "how many", "pieces", {1, 10}},
        Field{"gain", &ExampleParams::gain, "ratio of amplitudes", "", {0, 1}},
        Field{"weights", &ExampleParams::weights, "weight of each", "", {0}},
        Field{"shade", &ExampleParams::shade, "light or dark"},
    };
  }
};

std::string complaint(const ExampleParams& params) {
  try {
    check_fields(params);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Fields, DefaultsAreAllowed) { EXPECT_EQ(complaint({}), ""); }

TEST(Fields, OutOfRangeNamesTheFieldAndWhatIsAllowed) {
  EXPECT_EQ(complaint({.count = 11}), "count = 11: allowed are 1 to 10");
  EXPECT_EQ(complaint({.gain = -0.1}), "gain = -0.1: allowed are 0 to 1");
  EXPECT_EQ(complaint({.weights = {1, -2}}), "weights = -2: allowed are at least 0");
}

TEST(Fields, NotANumberIsNeverAllowed) {
  EXPECT_NE(complaint({.gain = std::numeric_limits<double>::quiet_NaN()}), "");
  EXPECT_NE(complaint({.weights = {std::numeric_limits<double>::infinity()}}), "");
}

TEST(Fields, WordsOfAnEnum) { EXPECT_EQ(to_word(Shade::dark), "dark"); }

TEST(ClosestWord, FindsTypingMistakesOnly) {
  const std::vector<std::string> words{"patch_size", "overlap", "tolerance"};
  EXPECT_EQ(closest_word("patchsize", words), "patch_size");
  EXPECT_EQ(closest_word("ovrelap", words), "overlap");
  EXPECT_EQ(closest_word("network", words), "");
}

}  // namespace
}  // namespace gramloom
