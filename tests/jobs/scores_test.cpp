// What a run says of its textures: scores in the records, diversity, scores.csv.
#include "metrics/scores.h"

#include <gtest/gtest.h>

#include <sstream>

#include "jobs/run_folder.h"
#include "runs/score_sheet.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> two_seeds{"seeds=[1,2]"};

class RunScores : public Runner {
 protected:
  std::vector<std::string> sheet() const {
    std::vector<std::string> lines;
    std::istringstream stream(read_text(out("scores.csv")));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  Json diversity() const { return Json::parse(read_text(out("run.json"))).at("diversity"); }
  // A run that the user stops when `stop` says so.
  RunSummary stopped(std::function<bool()> stop, bool resume = false) const {
    RunOptions options;
    options.resume = resume;
    options.stop = std::move(stop);
    return run_text(two_textures, options, two_seeds);
  }
};

TEST_F(RunScores, StandInTheRecordOfATextureFromAnExemplar) {
  run_text(two_textures, {}, {"tile=x"});
  const JobRecord scored = record("e/b/seed1");
  const Scores expected =
      score(read_image(folder_ / "e.png").image, read_image(out("e/b/seed1.png")).image, Tile::x);
  ASSERT_EQ(scored.metrics.size(), expected.values.size());
  for (const auto& [name, value] : expected.values)
    EXPECT_EQ(scored.metrics.at(std::string(name)), value) << name;
  EXPECT_TRUE(scored.metrics.contains("seam_x"));
  EXPECT_FALSE(scored.metrics.contains("seam_y"));
  EXPECT_EQ(scored.copy_map, "e/b/seed1.copy_map.png");
  EXPECT_EQ(read_image(out(scored.copy_map)).image.size(), (Size{24, 16}));
  EXPECT_GT(scored.score_seconds, 0);
  EXPECT_EQ(scored.score_error, "");

  const JobRecord noise = record("procedural/a/seed1");
  EXPECT_TRUE(noise.metrics.empty());
  EXPECT_EQ(noise.copy_map, "");
  EXPECT_FALSE(fs::exists(out("procedural/a/seed1.copy_map.png")));
}

TEST_F(RunScores, CanBeLeftOutAndAddedLater) {
  run_text(two_textures);
  run_text(two_textures, {}, {"scores=false"});
  EXPECT_TRUE(record("e/b/seed1").metrics.empty());
  EXPECT_FALSE(fs::exists(out("e/b/seed1.copy_map.png"))) << "that of the texture before";
  const auto time = fs::last_write_time(out("e/b/seed1.png"));
  EXPECT_EQ(resume(two_textures).skipped, 2);
  EXPECT_FALSE(record("e/b/seed1").metrics.empty());
  EXPECT_EQ(fs::last_write_time(out("e/b/seed1.png")), time) << "only scored";
}

TEST_F(RunScores, AScoringThatFailsDoesNotFailTheTexture) {
  run_text(two_textures);  // or the folder in the way would be a stranger's, and the run refused
  fs::remove(out("e/b/seed1.copy_map.png"));
  fs::create_directories(out("e/b/seed1.copy_map.png/in/the/way"));
  EXPECT_EQ(run_text(two_textures).failed, 0);
  const JobRecord unscored = record("e/b/seed1");
  EXPECT_EQ(unscored.status, Status::done);
  EXPECT_TRUE(unscored.metrics.empty());
  EXPECT_NE(unscored.score_error.find("seed1.copy_map.png"), std::string::npos);
  fs::remove_all(out("e/b/seed1.copy_map.png"));
  EXPECT_EQ(resume(two_textures).skipped, 2);
  EXPECT_FALSE(record("e/b/seed1").metrics.empty());
  EXPECT_EQ(record("e/b/seed1").score_error, "");
}

TEST_F(RunScores, DiversityIsThatOfTheTexturesOnDisk) {
  run_text(two_textures, {}, two_seeds);
  const Json list = diversity();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["exemplar"], "e");
  EXPECT_EQ(list[0]["method"], "b");
  const std::vector<Image> textures{read_image(out("e/b/seed1.png")).image,
                                    read_image(out("e/b/seed2.png")).image};
  EXPECT_EQ(list[0]["value"], gramloom::diversity(textures));

  const std::vector<std::string> other{"seeds=[1,2]", "patch_size=9"};
  RunOptions one;
  one.only = "e/b/seed2";
  one.resume = true;
  run_text(two_textures, one, other);
  EXPECT_NE(diversity()[0]["value"], list[0]["value"]) << "one of them is another texture now";
  run_text(two_textures, {}, {"seeds=[1]"});
  EXPECT_TRUE(diversity().empty()) << "one seed";
}

TEST_F(RunScores, SheetHasALineForEachJob) {
  run_text(two_textures, {}, two_seeds);
  const auto lines = sheet();
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[0].starts_with(
      "exemplar,method,kind,seed,status,seconds,peak_memory_mb,stsim2,portilla_simoncelli,"));
  EXPECT_TRUE(lines[0].ends_with(",seam_x,seam_y,join,diversity"));
  EXPECT_TRUE(lines[1].starts_with("procedural,a,procedural,1,done,")) << lines[1];
  EXPECT_TRUE(lines[4].starts_with("e,b,quilting,2,done,")) << lines[4];
  const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
  for (const auto& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas);
  EXPECT_TRUE(lines[4].ends_with(fmt::format(",,,{}", diversity()[0]["value"].get<double>())));
  EXPECT_EQ(resume(two_textures, two_seeds).skipped, 4);
  EXPECT_EQ(sheet(), lines);
}

// Red and green of a bright pixel are the place that the method took it from.
TEST_F(RunScores, CopyMapShowsTheSourcesThatTheMethodTells) {
  const Config config = parse_config(two_textures, folder_ / "c.toml");
  run_text(two_textures);
  const Image exemplar = read_image(folder_ / "e.png").image;
  const SourceMap source = run_method(config.methods[1].method,
                                      {{{exemplar}}, {config.size, config.tile}, Random(1)}, {})
                               .source;
  const Image map = read_image(out("e/b/seed1.copy_map.png")).image;
  ASSERT_EQ(map.size(), source.size);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Source* from = source.at(x, y);
      const float u = static_cast<float>(from->x) / static_cast<float>(exemplar.width - 1);
      const float v = static_cast<float>(from->y) / static_cast<float>(exemplar.height - 1);
      const float blue = 1 - (u + v) / 2;
      const float sum = map.at(x, y)[0] + map.at(x, y)[1] + map.at(x, y)[2];
      const float light = sum / (u + v + blue) > 0.6f ? 1.0f : 1.0f / 3;  // copied blocks, others
      ASSERT_NEAR(map.at(x, y)[0], light * u, 0.003f) << x << ", " << y;
      ASSERT_NEAR(map.at(x, y)[1], light * v, 0.003f) << x << ", " << y;
    }
}

TEST_F(RunScores, StoppedAtAnyMomentAndResumedTheyAreAllThere) {
  run_text(two_textures, {}, two_seeds);
  const auto whole = record("e/b/seed1").metrics;
  const Json whole_diversity = diversity();
  const Image whole_map = read_image(out("e/b/seed1.copy_map.png")).image;
  // Each question is a moment: before each job, at each of its steps, at each of its scores'.
  bool unscored = false;
  for (int moments = 1; moments < 200; moments += 3) {
    fs::remove_all(out(""));
    int asked = 0;
    const RunSummary first = stopped([&] { return ++asked > moments; });
    const bool complete = first.interrupted + first.left == 0 && !first.unscored;
    unscored |= first.unscored && first.left == 0;
    EXPECT_EQ(sheet().size(), 5u);
    const RunSummary rest = resume(two_textures, two_seeds);
    EXPECT_EQ(rest.done + rest.skipped, 4);
    EXPECT_FALSE(rest.unscored);
    ASSERT_EQ(record("e/b/seed1").metrics, whole) << "stopped at question " << moments;
    ASSERT_EQ(diversity(), whole_diversity) << "stopped at question " << moments;
    ASSERT_EQ(read_image(out("e/b/seed1.copy_map.png")).image, whole_map) << moments;
    if (complete) break;
  }
  EXPECT_TRUE(unscored) << "no stop was in the middle of the last scores";
}

}  // namespace
}  // namespace gramloom
