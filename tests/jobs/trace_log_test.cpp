#include "jobs/trace_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "io/text_file.h"
#include "runs/record.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

Progress at_step(std::int64_t step) {
  Progress progress;
  progress.step = step;
  progress.steps = 10;
  progress.evaluations = 2 * step;
  progress.loss = 1.0 / static_cast<double>(step + 1);
  progress.terms = {{"pool1", 0.1}, {"pool2", 1.0 / 3}};
  return progress;
}

class TraceLogFile : public testing::Test {
 protected:
  ~TraceLogFile() override { fs::remove(file_); }
  const fs::path file_ = fs::temp_directory_path() / fmt::format("gramloom_trace_{}.csv", getpid());

  std::vector<std::int64_t> steps(const TraceLog& log) const {
    std::vector<std::int64_t> result;
    for (const auto& row : log.trace().rows) result.push_back(row.step);
    return result;
  }
};

TEST_F(TraceLogFile, IsOnDiskAfterEachStep) {
  TraceLog log(file_, "mark");
  EXPECT_FALSE(log.continues());
  for (int step = 0; step < 3; ++step) {
    log.add(at_step(step));
    EXPECT_EQ(parse_trace(read_text(file_)).rows.size(), static_cast<std::size_t>(step + 1));
  }
  EXPECT_EQ(log.trace().terms, (std::vector<std::string>{"pool1", "pool2"}));
}

TEST_F(TraceLogFile, IgnoresReportsWithoutLossAndOfTheSameStep) {
  TraceLog log(file_, "mark");
  Progress no_loss;
  no_loss.step = 4;
  log.add(no_loss);
  EXPECT_FALSE(fs::exists(file_));
  log.add(at_step(5));
  log.add(at_step(5));
  EXPECT_EQ(steps(log), (std::vector<std::int64_t>{5}));
}

TEST_F(TraceLogFile, GoesOnWhereTheCheckpointWas) {
  double seconds = 0;
  {
    TraceLog log(file_, "mark");
    for (int step = 0; step < 8; ++step) log.add(at_step(step));
    seconds = log.trace().rows[4].seconds;
  }
  std::ofstream(file_, std::ios::app) << "8,16,0.0";  // killed while it wrote
  TraceLog log(file_, "mark");
  ASSERT_TRUE(log.continues());
  log.add(at_step(5));  // the checkpoint was of step 4 or 5
  log.add(at_step(6));
  EXPECT_EQ(steps(log), (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_GE(log.trace().rows[5].seconds, seconds);
  const Trace on_disk = parse_trace(read_text(file_));
  ASSERT_EQ(on_disk.rows.size(), 7u);
  EXPECT_EQ(on_disk.rows[6].loss, at_step(6).loss);
}

TEST_F(TraceLogFile, OfOtherSettingsIsNotContinued) {
  { TraceLog(file_, "one").add(at_step(1)); }
  EXPECT_TRUE(TraceLog(file_, "one").continues());
  TraceLog other(file_, "two");
  EXPECT_FALSE(other.continues());
  EXPECT_TRUE(other.trace().rows.empty());
}

TEST_F(TraceLogFile, RestartForgets) {
  { TraceLog(file_, "one").add(at_step(1)); }
  TraceLog log(file_, "one");
  log.restart();
  EXPECT_FALSE(fs::exists(file_));
  log.add(at_step(3));
  EXPECT_EQ(steps(log), (std::vector<std::int64_t>{3}));
}

}  // namespace
}  // namespace gramloom
