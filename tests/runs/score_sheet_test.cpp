#include "runs/score_sheet.h"

#include <gtest/gtest.h>

namespace gramloom {
namespace {

TEST(ScoreSheet, QuotesNamesAndLeavesOutWhatIsUndefined) {
  JobRecord half;
  half.status = Status::done;
  half.metrics = {{"stsim2", 0.5}, {"repetition", nullptr}};
  const std::string sheet = score_sheet(
      {{"n", "a,b", "say \"so\"", "quilting", 3, half}, {"m", "e", "q", "phase", 4, {}}},
      {{"e", "q", {1, 2}, 0.25}}, {"stsim2", "repetition", "diversity"});
  EXPECT_NE(sheet.find("\n\"a,b\",\"say \"\"so\"\"\",quilting,3,done,0,0,0.5,,"), std::string::npos)
      << sheet;
  EXPECT_NE(sheet.find("\ne,q,phase,4,waiting,,,"), std::string::npos) << sheet;
}

}  // namespace
}  // namespace gramloom
