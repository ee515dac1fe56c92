#include "core/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <vector>

#include "core/error.h"

namespace gramloom {
namespace {

class ParallelFor : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { set_thread_count(GetParam()); }
  void TearDown() override { set_thread_count(0); }
};

TEST_P(ParallelFor, VisitsEachIndexOnce) {
  std::vector<std::atomic<int>> visits(1003);
  parallel_for(1003, 10, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
  });
  for (const auto& n : visits) EXPECT_EQ(n, 1);
}

TEST_P(ParallelFor, SplitsTheSameWayForAnyThreads) {
  std::set<std::pair<std::int64_t, std::int64_t>> ranges;
  std::mutex mutex;
  parallel_for(25, 10, [&](std::int64_t begin, std::int64_t end) {
    const std::lock_guard lock(mutex);
    ranges.emplace(begin, end);
  });
  EXPECT_EQ(ranges, (std::set<std::pair<std::int64_t, std::int64_t>>{{0, 10}, {10, 20}, {20, 25}}));
}

TEST_P(ParallelFor, ThrowsWhatABodyThrew) {
  EXPECT_THROW(parallel_for(100, 1,
                            [](std::int64_t i, std::int64_t) {
                              if (i == 50) throw Error("fifty");
                            }),
               Error);
}

TEST_P(ParallelFor, NothingToDo) {
  parallel_for(0, 1, [](std::int64_t, std::int64_t) { FAIL(); });
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 2, 8));

TEST(Threads, RefusesNonsense) {
  EXPECT_THROW(set_thread_count(-1), Error);
  EXPECT_THROW(set_thread_count(5000), Error);
}

}  // namespace
}  // namespace gramloom
