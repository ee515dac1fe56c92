// What the likeness scores promise, on textures whose faults are known.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "metrics/controls.h"
#include "metrics/pictures.h"

namespace gramloom {
namespace {

struct Subject {
  std::string name;
  Image exemplar;
};

std::vector<Subject> subjects(int side = 128) {
  return {{"brick", brick(1, side)}, {"pebbles", pebbles(1, side)}, {"stones", stones(1, side)}};
}

/// How far from a perfect score.
double loss(const Scores& scores, const Metric& metric) {
  const double score = value(scores, metric.name);
  return metric.higher_is_better ? 1 - score : score;
}

template <class F>
void for_each_likeness(const F& f) {
  for (const Metric& metric : metrics())
    if (metric.group == "likeness") f(metric);
}

Scores control_scores(ControlKind kind, const Image& exemplar) {
  const ControlPair pair = control_pair(kind, exemplar, exemplar.size(), Random(3));
  return score(pair.exemplar, pair.image, Tile::none);
}

TEST(Likeness, TheExemplarItselfIsPerfect) {
  for (const auto& [name, exemplar] : subjects()) {
    const Scores scores = score(exemplar, exemplar, Tile::none);
    for_each_likeness(
        [&](const Metric& m) { EXPECT_NEAR(loss(scores, m), 0, 1e-9) << name << " " << m.name; });
  }
}

// Each of the scores that take in structure tells a good synthesis from both controls.
TEST(Likeness, StructureTellsASynthesisFromShuffledPixelsAndRandomPhase) {
  for (const auto& [name, exemplar] : subjects(192)) {
    const Scores good = score(exemplar, optimised(exemplar), Tile::none);
    const Scores shuffled = control_scores(ControlKind::shuffled, exemplar);
    const Scores phase = control_scores(ControlKind::random_phase, exemplar);
    for (const Metric& m : metrics())
      if (m.name == "stsim2" || m.name == "portilla_simoncelli" || m.name == "random_features") {
        EXPECT_GT(loss(shuffled, m), 3 * loss(good, m)) << name << " " << m.name;
        const double margin = m.name == "random_features" ? 1.25 : 1.5;
        EXPECT_GT(loss(phase, m), margin * loss(good, m)) << name << " " << m.name;
      }
    for (const char* m : {"patch_wasserstein", "spectrum_db", "autocorrelation"})
      EXPECT_GT(value(shuffled, m), 1.5 * value(good, m)) << name << " " << m;
  }
}

// What fools a score is as documented: these are the reasons for having the others.
TEST(Likeness, SomeScoresAreBlind) {
  for (const auto& [name, exemplar] : subjects()) {
    const Scores shuffled = control_scores(ControlKind::shuffled, exemplar);
    const Scores phase = control_scores(ControlKind::random_phase, exemplar);
    EXPECT_EQ(value(shuffled, "colour_wasserstein"), 0) << name;
    EXPECT_LT(value(phase, "spectrum_db"), 0.25 * value(shuffled, "spectrum_db")) << name;
  }
}

TEST(Likeness, AShiftedCropIsNearlyPerfect) {
  for (const auto& [name, exemplar] : subjects()) {
    const Scores crop = score(exemplar, window(exemplar, 7, 10, {112, 108}), Tile::none);
    const Scores shuffled = control_scores(ControlKind::shuffled, exemplar);
    for_each_likeness([&](const Metric& m) {
      if (m.name != "colour_wasserstein") {
        EXPECT_LT(loss(crop, m), 0.5 * loss(shuffled, m)) << name << " " << m.name;
      }
    });
    EXPECT_GT(value(crop, "stsim2"), 0.97) << name;
    EXPECT_LT(value(crop, "colour_wasserstein"), 0.1) << name;
  }
}

TEST(Likeness, MoreNoiseIsWorse) {
  for (const auto& [name, exemplar] : subjects()) {
    Scores last = score(exemplar, exemplar, Tile::none);
    for (const float deviation : {0.02f, 0.05f, 0.1f, 0.2f}) {
      const Scores next = score(exemplar, noisy(exemplar, deviation), Tile::none);
      for_each_likeness([&](const Metric& m) {
        EXPECT_GT(loss(next, m), loss(last, m)) << name << " " << m.name << " " << deviation;
      });
      last = next;
    }
  }
}

TEST(Likeness, MoreBlurIsWorse) {
  for (const auto& [name, exemplar] : subjects()) {
    Scores last = score(exemplar, exemplar, Tile::none);
    for (const double deviation : {0.5, 1.0, 2.0, 4.0}) {
      const Scores next = score(exemplar, blurred(exemplar, deviation), Tile::none);
      for_each_likeness([&](const Metric& m) {
        EXPECT_GT(loss(next, m), loss(last, m)) << name << " " << m.name << " " << deviation;
      });
      last = next;
    }
  }
}

TEST(Likeness, AnotherTextureIsWorseThanAnotherSample) {
  const std::vector<Subject> exemplars = subjects(), others{{"brick", brick(2)},
                                                            {"pebbles", pebbles(2)},
                                                            {"stones", stones(2)}};
  for (const auto& [name, exemplar] : exemplars)
    for (const auto& [same, sample] : others)
      for (const auto& [other, unlike] : others) {
        if (same != name || other == name) continue;
        const Scores like = score(exemplar, sample, Tile::none);
        const Scores not_like = score(exemplar, unlike, Tile::none);
        for_each_likeness([&](const Metric& m) {
          EXPECT_GT(loss(not_like, m), loss(like, m)) << name << " " << other << " " << m.name;
        });
      }
}

// Offset and gain of both images together change nothing but rounding.
TEST(Likeness, DoesNotDependOnUnits) {
  const Image exemplar = pebbles(), image = quilted(exemplar);
  const auto rescaled = [](Image i) {
    for (float& v : i.pixels) v = 40 * v - 7;
    return i;
  };
  const Scores one = score(exemplar, image, Tile::none);
  const Scores other = score(rescaled(exemplar), rescaled(image), Tile::none);
  for_each_likeness([&](const Metric& m) {
    EXPECT_NEAR(value(one, m.name), value(other, m.name), 2e-4 * (1 + value(one, m.name)))
        << m.name;
  });
}

}  // namespace
}  // namespace gramloom
