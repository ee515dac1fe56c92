// gramloom score from outside.
#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Score : public Workspace {};

TEST_F(Score, AnExemplarAgainstItselfIsACopyOfFullLikeness) {
  const Outcome table = run({"score", "e.png", "e.png", "--tile", "both", "--controls"});
  EXPECT_EQ(table.exit_code, 0) << table.errors;
  EXPECT_NE(table.output.find("copied_share"), std::string::npos);
  EXPECT_NE(table.output.find("control:random_phase"), std::string::npos);
  const Outcome json = run({"score", "e.png", "e.png", "--tile", "x", "--json"});
  EXPECT_EQ(json.exit_code, 0);
  EXPECT_NE(json.output.find("\"seam_x\""), std::string::npos);
  EXPECT_EQ(json.output.find("\"seam_y\""), std::string::npos);
  EXPECT_NE(json.output.find("\"copied_share\": 1.0"), std::string::npos) << json.output;
}

TEST_F(Score, OneBadFileDoesNotStopTheOthers) {
  write_text(folder_ / "no picture.png", "no picture");
  write_image(folder_ / "grey.png", Image(32, 32, 1, 0.5f), {});
  const Outcome outcome =
      run({"score", "e.png", "no picture.png", "e.png", "gone.png", "grey.png", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const Json json = Json::parse(outcome.output);
  EXPECT_EQ(json.size(), 1u);
  EXPECT_EQ(json["e.png"]["copied_share"], 1.0);
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 3) << outcome.errors;
  for (const std::string name : {"no picture.png", "gone.png", "grey.png"})
    EXPECT_NE(outcome.errors.find(name), std::string::npos) << outcome.errors;
  const Outcome table = run({"score", "e.png", "gone.png", "e.png"});
  EXPECT_EQ(table.exit_code, 1);
  EXPECT_NE(table.output.find("copied_share"), std::string::npos);
}

TEST_F(Score, ANameThatIsNoUtf8IsReplacedInJson) {
  const std::string name = "caf\xE9.png";
  fs::copy_file(folder_ / "e.png", folder_ / name);
  const Outcome outcome = run({"score", "e.png", name, "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(Json::parse(outcome.output).contains("caf\xEF\xBF\xBD.png")) << outcome.output;
}

TEST_F(Score, BadInputIsOneLine) {
  const Outcome missing = run({"score", "e.png", "no.png"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_TRUE(is_one_line(missing.errors)) << missing.errors;
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"score"}, {"score", "e.png"}, {"score", "e.png", "e.png", "--tile", "z"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  }
}

}  // namespace
}  // namespace gramloom
