// gramloom score from outside.
#include "cli/workspace.h"

namespace gramloom {
namespace {

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
