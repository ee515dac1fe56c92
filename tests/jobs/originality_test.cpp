// `originality` of neural moves along one line: the less of it, the more is copied, and the more
// like the exemplar the picture is.
#include <gtest/gtest.h>

#include "io/image_file.h"
#include "jobs/methods.h"
#include "metrics/scores.h"
#include "signal/resize.h"
#include "source_folder.h"

namespace gramloom {
namespace {

struct Likeness {
  double copied = 0, distance = 0;  // distance: from a perfect STSIM-2
};

// The mean of two seeds.
Likeness likeness(const Image& exemplar, double originality) {
  NeuralParams params = with_preset(Preset::fast);
  params.layout = Layout::flow;
  params.iterations = {10};
  params.originality = originality;
  Likeness mean;
  for (const std::uint64_t seed : {1, 2}) {
    const Request request{{{exemplar}}, {exemplar.size(), Tile::both}, Random(seed)};
    const Image image = run_method(Method(params), request, {}).image;
    for (const auto& [name, value] : score(exemplar, image, Tile::both).values) {
      if (name == "copied_share") mean.copied += value / 2;
      if (name == "stsim2") mean.distance += (1 - value) / 2;
    }
  }
  return mean;
}

class Originality : public testing::TestWithParam<const char*> {};

TEST_P(Originality, TheLessTheMoreIsCopiedAndTheMoreItIsLikeTheExemplar) {
  const Image exemplar = fit_longer_side(
      read_image(source_folder() / "data" / (std::string(GetParam()) + ".png")).image, 128);
  const Likeness free = likeness(exemplar, 1), middle = likeness(exemplar, 0.5),
                 close = likeness(exemplar, 0);
  EXPECT_LE(free.copied, middle.copied + 0.01);
  EXPECT_LT(middle.copied, close.copied);
  EXPECT_LT(close.distance, free.distance);
}

INSTANTIATE_TEST_SUITE_P(Exemplars, Originality, testing::Values("pebbles", "grass", "stone_wall"));

}  // namespace
}  // namespace gramloom
