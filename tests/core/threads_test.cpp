#include "core/threads.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "core/control_group.h"
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

TEST_P(ParallelFor, ALoopInsideAnotherRunsInItsThread) {
  std::atomic<int> visits{0}, elsewhere{0};
  parallel_for(16, 1, [&](std::int64_t, std::int64_t) {
    const auto self = std::this_thread::get_id();
    parallel_for(16, 1, [&](std::int64_t, std::int64_t) {
      ++visits;
      if (std::this_thread::get_id() != self) ++elsewhere;
    });
  });
  EXPECT_EQ(visits, 256);
  EXPECT_EQ(elsewhere, 0);
}

TEST_P(ParallelFor, LoopsOfSeveralThreadsDoNotMix) {
  std::vector<std::thread> callers;
  std::array<std::atomic<std::int64_t>, 4> sums{};
  for (std::size_t c = 0; c < sums.size(); ++c)
    callers.emplace_back([&, c] {
      for (int repeat = 0; repeat < 200; ++repeat)
        parallel_for(100, 3, [&](std::int64_t begin, std::int64_t end) {
          for (auto i = begin; i < end; ++i) sums[c] += i;
        });
    });
  for (auto& caller : callers) caller.join();
  for (const auto& sum : sums) EXPECT_EQ(sum, 200 * 4950);
}

TEST_P(ParallelFor, ManyShortLoops) {
  std::atomic<std::int64_t> sum{0};
  for (int repeat = 0; repeat < 20000; ++repeat)
    parallel_for(4, 1, [&](std::int64_t i, std::int64_t) { sum += i; });
  EXPECT_EQ(sum, 20000 * 6);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 2, 8));

TEST(Threads, RefusesNonsense) {
  EXPECT_THROW(set_thread_count(-1), Error);
  EXPECT_THROW(set_thread_count(5000), Error);
}

// What `in_child` returns, called in a child of this process.
template <class F>
int exit_code_of(F&& in_child) {
  const pid_t child = fork();
  if (child == 0) _exit(in_child());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int sum_to(std::int64_t count) {
  std::atomic<int> sum{0};
  parallel_for(count, 1, [&](std::int64_t i, std::int64_t) { sum += static_cast<int>(i); });
  return sum;
}

TEST(Threads, AChildWithoutItsParentsThreadsWorksAlone) {
  set_thread_count(4);
  EXPECT_EQ(sum_to(20), 190);
  EXPECT_EQ(exit_code_of([] {
              alarm(20);  // in place of a hang
              return sum_to(20);
            }),
            190);
  set_thread_count(0);
}

TEST(Threads, WhereNoThreadCanBeMadeTheCallerWorksAlone) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer needs the address space, or threads of one process";
#endif
  EXPECT_EQ(exit_code_of([] {
              alarm(20);
              set_thread_count(64);
              const rlimit none{0, 0};
              setrlimit(RLIMIT_AS, &none);
              return sum_to(20);
            }),
            190);
}

class Quota : public testing::Test {
 protected:
  Quota() { std::filesystem::create_directories(folder_); }
  ~Quota() override { std::filesystem::remove_all(folder_); }
  double with(const char* file, const char* text) const {
    std::ofstream(folder_ / file) << text;
    return core_quota(folder_);
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("gramloom_quota_" + std::to_string(getpid()));
};

TEST_F(Quota, OfControlGroupsIsReadInBothVersions) {
  EXPECT_TRUE(std::isinf(core_quota(folder_)));
  EXPECT_TRUE(std::isinf(with("cpu.cfs_period_us", "100000\n")));
  EXPECT_TRUE(std::isinf(with("cpu.cfs_quota_us", "-1\n")));
  EXPECT_EQ(with("cpu.cfs_quota_us", "250000\n"), 2.5);
  EXPECT_TRUE(std::isinf(with("cpu.max", "max 100000\n")));
  EXPECT_EQ(with("cpu.max", "150000 100000\n"), 1.5);
  EXPECT_TRUE(std::isinf(with("cpu.max", "0 0\n")));
}

TEST(Threads, CountsTheCoresThatAffinityAllows) {
  cpu_set_t cores;
  ASSERT_EQ(sched_getaffinity(0, sizeof cores, &cores), 0);
  EXPECT_LE(thread_count(), CPU_COUNT(&cores));
  EXPECT_GE(thread_count(), 1);
}

}  // namespace
}  // namespace gramloom
