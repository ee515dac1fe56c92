#include "runs/trace_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "runs/record.h"

namespace gramloom {
namespace {

TEST(Trace, NumbersComeBackAsTheyWere) {
  const Trace trace{{"a", "b"},
                    {{0, 1, 0.25, 1.0 / 3, {0.1, 1e-300}}, {1, 3, 0.5, 1e22, {2, 3e-7}}}};
  EXPECT_EQ(parse_trace(to_csv(trace)), trace);
  EXPECT_EQ(to_csv(trace).substr(0, to_csv(trace).find('\n')), "step,evaluations,seconds,loss,a,b");
}

TEST(Trace, NamesComeBackAsTheyWere) {
  for (const std::string name : {"a,b", "\"", "line\nend", "#", "", " x ", "\r"}) {
    const Trace trace{{name, "b"}, {{0, 1, 0.25, 0.5, {1, 2}}}};
    EXPECT_EQ(parse_trace("# mark\n" + to_csv(trace)), trace) << name;
  }
  EXPECT_EQ(to_csv(Trace{{"a,b", "c\"d"}, {}}),
            "step,evaluations,seconds,loss,\"a,b\",\"c\"\"d\"\n");
}

TEST(Trace, ACellThatIsNoNumberIsNamed) {
  try {
    parse_trace("step,evaluations,seconds,loss\n1,2,0.5,x\n");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "loss: 'x' is not a number");
  }
}

TEST(Trace, ALineThatWasCutOffIsLeftOut) {
  const Trace trace{{}, {{0, 1, 0.25, 0.5, {}}, {1, 3, 0.5, 0.125, {}}}};
  const std::string csv = to_csv(trace);
  for (std::size_t length = csv.find('\n') + 1; length < csv.size(); ++length) {
    const Trace read = parse_trace(csv.substr(0, length));
    ASSERT_LT(read.rows.size(), 2u);
    if (!read.rows.empty()) {
      EXPECT_EQ(read.rows[0], trace.rows[0]);
    }
  }
}

TEST(Trace, SummaryIsOfTheFirstAndLastStep) {
  EXPECT_FALSE(summarise({}));
  const auto summary = summarise({{}, {{0, 1, 0, 4, {}}, {9, 12, 1, 2, {}}}});
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->iterations, 9);
  EXPECT_EQ(summary->evaluations, 12);
  EXPECT_EQ(summary->first, 4);
  EXPECT_EQ(summary->last, 2);
}

}  // namespace
}  // namespace gramloom
