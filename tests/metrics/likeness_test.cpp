// What the likeness scores promise, on textures whose faults are known.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "metrics/controls.h"
#include "metrics/exemplar_statistics.h"
#include "metrics/pictures.h"

namespace gramloom {
namespace {

struct Subject {
  std::string name;
  Image exemplar;
};

/// Of an exemplar that is scored against several pictures.
Scores scored(ExemplarStatistics& exemplar, const Image& image) {
  return score(exemplar, image, Tile::none);
}

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

Scores control_scores(ControlKind kind, ExemplarStatistics& exemplar) {
  const Image& own = exemplar.exemplar();
  return scored(exemplar, control_pair(kind, own, own.size(), Random(3)).image);
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
    ExemplarStatistics statistics(exemplar);
    const Scores good = scored(statistics, optimised(exemplar));
    const Scores shuffled = control_scores(ControlKind::shuffled, statistics);
    const Scores phase = control_scores(ControlKind::random_phase, statistics);
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
    ExemplarStatistics statistics(exemplar);
    const Scores shuffled = control_scores(ControlKind::shuffled, statistics);
    const Scores phase = control_scores(ControlKind::random_phase, statistics);
    EXPECT_EQ(value(shuffled, "colour_wasserstein"), 0) << name;
    EXPECT_LT(value(phase, "spectrum_db"), 0.25 * value(shuffled, "spectrum_db")) << name;
  }
}

TEST(Likeness, AShiftedCropIsNearlyPerfect) {
  for (const auto& [name, exemplar] : subjects()) {
    ExemplarStatistics statistics(exemplar);
    const Scores crop = scored(statistics, window(exemplar, 7, 10, {112, 108}));
    const Scores shuffled = control_scores(ControlKind::shuffled, statistics);
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
    ExemplarStatistics statistics(exemplar);
    Scores last = scored(statistics, exemplar);
    for (const float deviation : {0.02f, 0.05f, 0.1f, 0.2f}) {
      const Scores next = scored(statistics, noisy(exemplar, deviation));
      for_each_likeness([&](const Metric& m) {
        EXPECT_GT(loss(next, m), loss(last, m)) << name << " " << m.name << " " << deviation;
      });
      last = next;
    }
  }
}

TEST(Likeness, MoreBlurIsWorse) {
  for (const auto& [name, exemplar] : subjects()) {
    ExemplarStatistics statistics(exemplar);
    Scores last = scored(statistics, exemplar);
    for (const double deviation : {0.5, 1.0, 2.0, 4.0}) {
      const Scores next = scored(statistics, blurred(exemplar, deviation));
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
  for (std::size_t i = 0; i < exemplars.size(); ++i) {
    ExemplarStatistics statistics(exemplars[i].exemplar);
    const Scores like = scored(statistics, others[i].exemplar);
    for (std::size_t j = 0; j < others.size(); ++j) {
      if (j == i) continue;
      const Scores not_like = scored(statistics, others[j].exemplar);
      for_each_likeness([&](const Metric& m) {
        EXPECT_GT(loss(not_like, m), loss(like, m))
            << exemplars[i].name << " " << others[j].name << " " << m.name;
      });
    }
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
