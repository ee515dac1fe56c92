#include "jobs/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/hash.h"
#include "core/threads.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "runs/csv.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string tiny =
    "poses = 5\nseed = 3\nbend = [20, 90]\n"
    "[sleeve]\nsize = [16, 24]\nsteps = 6\niterations = 3\n";

class SimulationTest : public testing::Test {
 protected:
  SimulationTest()
      : folder_(fs::temp_directory_path() / fmt::format("gramloom_simulation_{}", getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~SimulationTest() override {
    set_thread_count(0);
    fs::remove_all(folder_);
  }

  // All files of the data set, names and bytes.
  std::string made(const std::string& text, int threads) const {
    set_thread_count(threads);
    const fs::path folder = folder_ / fmt::format("threads{}", threads);
    make_simulation(parse_simulation(text, "s.toml"), folder, {});
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string bytes;
    for (const fs::path& file : files) bytes += file.filename().string() + read_text(file);
    return bytes;
  }

  const fs::path folder_;
};

std::string refusal(const std::string& text) {
  try {
    parse_simulation(text, "s.toml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST_F(SimulationTest, IsReproducedByteForByte) {
  const std::string one = made(tiny, 1);
  EXPECT_EQ(made(tiny, 2), one);
  EXPECT_EQ(made(tiny, 3), one);
  // Whatever the machine: the table, and all values. (Files also depend on OpenEXR's version.)
  Fnv1a hash;
  hash.add(read_text(folder_ / "threads1/poses.csv"));
  for (const PosedSleeve& sleeve : simulate(parse_simulation(tiny, "s.toml"), {}))
    hash.add(sleeve.displacement.pixels.data(), sleeve.displacement.pixels.size() * sizeof(float));
  EXPECT_EQ(hash.text(), "97db275b9ac52e71");
}

TEST_F(SimulationTest, TheTableNamesThePictures) {
  made(tiny, 1);
  const auto rows = parse_csv(read_text(folder_ / "threads1/poses.csv"));
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0], (CsvRow{"picture", "bend", "twist", "swing"}));
  const auto sleeves = simulate(parse_simulation(tiny, "s.toml"), {});
  for (std::size_t i = 0; i < sleeves.size(); ++i) {
    EXPECT_EQ(std::stod(rows[i + 1][1]), sleeves[i].pose.bend);
    EXPECT_EQ(read_image(folder_ / "threads1" / rows[i + 1][0]).image, sleeves[i].displacement);
  }
}

TEST_F(SimulationTest, PosesAreSpreadOverTheirRanges) {
  SimulationParams params;
  params.bend = {10, 90};
  const auto poses = poses_of(params);
  ASSERT_EQ(poses.size(), 240u);
  int low = 0, left = 0;
  for (const Pose& pose : poses) {
    EXPECT_TRUE(pose.bend >= 10 && pose.bend <= 90 && std::abs(pose.twist) <= 60);
    low += pose.bend < 50;
    left += pose.twist < 0;
  }
  EXPECT_NEAR(low, 120, 3);
  EXPECT_NEAR(left, 120, 3);
  params.seed = 2;
  EXPECT_NE(poses_of(params).front(), poses.front());
  params.bend = {45, 45};
  EXPECT_EQ(poses_of(params).back().bend, 45);
}

TEST_F(SimulationTest, FilesOfOthersStay) {
  const Simulation simulation = parse_simulation(tiny, "s.toml");
  write_text(folder_ / "poses.csv", "my,own,table\n");
  EXPECT_THROW(make_simulation(simulation, folder_, {}), ConfigError);
  fs::remove(folder_ / "poses.csv");
  write_image(folder_ / "pose_0002.exr", Image(2, 2, 1), {});
  EXPECT_THROW(make_simulation(simulation, folder_, {}), ConfigError);
  EXPECT_FALSE(fs::exists(folder_ / "pose_0001.exr"));
  fs::remove(folder_ / "pose_0002.exr");
  make_simulation(simulation, folder_, {});
  EXPECT_NO_THROW(make_simulation(simulation, folder_, {})) << "its own are replaced";
}

TEST_F(SimulationTest, StoppedItLeavesNothing) {
  Control control;
  control.progress = [](const Progress& p) { return p.step < 2; };
  EXPECT_THROW(make_simulation(parse_simulation(tiny, "s.toml"), folder_ / "o", control),
               Interrupted);
  EXPECT_TRUE(fs::is_empty(folder_ / "o"));
}

TEST_F(SimulationTest, MistakesAreToldWithTheirPlace) {
  EXPECT_EQ(refusal("pose = 3\n"), "s.toml:1:1: unknown key 'pose' (did you mean 'poses'?)");
  EXPECT_THAT(refusal("poses = 0\n"),
              HasSubstr("s.toml:1:1: 'poses' = 0: allowed are 1 to 100000"));
  EXPECT_EQ(refusal("\nbend = [90, 10]\n"), "s.toml:2:1: 'bend' = [90, 10]: the least comes first");
  EXPECT_EQ(refusal("twist = 5\n"),
            "s.toml:1:1: 'twist' has 1 numbers, allowed are the least and the most");
  EXPECT_THAT(refusal("bend = [0, 170]\n"), HasSubstr("'bend' = 170: allowed are 0 to 120"));
  EXPECT_THAT(refusal("[sleeve]\nsize = 4\n"), HasSubstr("'size' = 4: allowed are 8 to 512"));
  EXPECT_THAT(refusal("[sleeve]\nslak = 0.1\n"), HasSubstr("did you mean 'slack'?"));
  EXPECT_NE(refusal("sleeve = 3\n"), "");
  const Simulation large = parse_simulation("poses = 100000\n[sleeve]\nsize = 512\n", "s.toml");
  EXPECT_THROW(simulate(large, {}), ConfigError);
}

}  // namespace
}  // namespace gramloom
