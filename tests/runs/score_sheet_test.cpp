#include "runs/score_sheet.h"

#include <gtest/gtest.h>

#include "runs/filled.h"

namespace gramloom {
namespace {

JobRecord record_of(const std::string& exemplar, const std::string& method, const std::string& kind,
                    int seed) {
  JobRecord record;
  record.exemplar = exemplar;
  record.method = method;
  record.kind = kind;
  record.seed = seed;
  record.status = Status::waiting;
  return record;
}

TEST(ScoreSheet, QuotesNamesAndLeavesOutWhatIsUndefined) {
  JobRecord half = record_of("a,b", "say \"so\"", "quilting", 2147483647);
  half.status = Status::done;
  half.metrics = {{"stsim2", 0.5}, {"repetition", std::nullopt}};
  const ScoreSheet sheet =
      score_sheet({{"n", half}, {"m", record_of("e", "q", "phase", 4)}},
                  {{"e", "q", {1, 2}, 0.25, ""}}, {"stsim2", "repetition", "diversity"});
  const std::string csv = to_csv(sheet);
  EXPECT_NE(csv.find("\n\"a,b\",\"say \"\"so\"\"\",quilting,2147483647,done,0,0,0.5,,\n"),
            std::string::npos)
      << csv;
  EXPECT_NE(csv.find("\ne,q,phase,4,waiting,,,"), std::string::npos) << csv;
  EXPECT_EQ(parse_score_sheet(csv), sheet);
}

TEST(ScoreSheet, EveryFieldComesBackAsItWas) {
  int count = 0;
  ScoreSheet sheet{{"plain", "odd, \"name\""}, {filled<ScoreRow>(count), filled<ScoreRow>(count)}};
  sheet.rows[0].scores = {1.0 / 3, std::nullopt};
  sheet.rows[1].scores = {std::nullopt, -1e-300};
  sheet.rows[1].exemplar = "#1";
  EXPECT_EQ(parse_score_sheet(to_csv(sheet)), sheet);
}

TEST(ScoreSheet, ALineOfSomethingElseIsAnError) {
  EXPECT_THROW(parse_score_sheet("a,b\n"), Error);
  EXPECT_THROW(parse_score_sheet(to_csv(ScoreSheet{}) + "e,q,phase,four,done,,\n"), Error);
  EXPECT_THROW(parse_score_sheet(to_csv(ScoreSheet{}) + "e,q,phase,4,doen,,\n"), Error);
}

}  // namespace
}  // namespace gramloom
