#include "jobs/shard.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "core/random.h"

namespace gramloom {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_shard(text);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Shard, IsReadFromTwoNumbers) {
  const Shard shard = parse_shard("3/16");
  EXPECT_EQ(shard.index, 3);
  EXPECT_EQ(shard.count, 16);
  for (const auto* text : {"", "3", "0/4", "5/4", "-1/4", "1/0", "a/b", "1/2/3", "1 /2", "1/1e3",
                           "1/100001", "99999999999999/2", "/", "1/"})
    EXPECT_NE(error_of(text), "") << text;
  EXPECT_EQ(error_of("5/4"),
            "'5/4' is no shard: a shard K of N is K/N, with K from 1 to N and N at most 100000");
}

class SlurmShard : public testing::Test {
 protected:
  ~SlurmShard() override {
    for (const auto* name : names_) unsetenv(fmt::format("SLURM_ARRAY_TASK_{}", name).c_str());
  }
  void set(const std::map<std::string, std::string>& values) {
    for (const auto& [name, value] : values)
      setenv(("SLURM_ARRAY_TASK_" + name).c_str(), value.c_str(), 1);
  }
  static constexpr auto names_ = std::to_array<const char*>({"ID", "COUNT", "MIN", "STEP"});
};

TEST_F(SlurmShard, IsThatOfTheArraysTask) {
  set({{"ID", "0"}, {"COUNT", "16"}, {"MIN", "0"}});  // --array=0-15
  EXPECT_EQ(shard_of_slurm().index, 1);
  set({{"ID", "10"}, {"COUNT", "4"}, {"MIN", "2"}, {"STEP", "4"}});  // --array=2-14:4
  EXPECT_EQ(shard_of_slurm().index, 3);
  EXPECT_EQ(shard_of_slurm().count, 4);
}

TEST_F(SlurmShard, IsAnErrorElsewhere) {
  EXPECT_THROW(shard_of_slurm(), Error);
  set({{"ID", "x"}, {"COUNT", "4"}});
  EXPECT_THROW(shard_of_slurm(), Error);
  set({{"ID", "9"}, {"COUNT", "4"}, {"MIN", "1"}});
  EXPECT_THROW(shard_of_slurm(), Error);
}

Plan plan_of_random_jobs(int count) {
  Plan plan;
  Random random(1);
  for (int i = 0; i < count; ++i) {
    PlannedJob planned;
    planned.job.seed = i;
    planned.cost.work.serial = std::exp(6 * random.uniform());
    planned.selected = i % 7 != 0;
    plan.jobs.push_back(planned);
  }
  return plan;
}

TEST(Shard, AllShardsTogetherHaveEachSelectedJobOnce) {
  const Plan plan = plan_of_random_jobs(500);
  std::vector<int> times(plan.jobs.size());
  for (int i = 1; i <= 6; ++i) {
    Plan part = plan;
    select_shard(part, {i, 6});
    for (std::size_t j = 0; j < times.size(); ++j) times[j] += part.jobs[j].selected ? 1 : 0;
  }
  for (std::size_t j = 0; j < times.size(); ++j) EXPECT_EQ(times[j], plan.jobs[j].selected ? 1 : 0);
}

TEST(Shard, TheBusiestHasAtMostAThirdMoreThanItsShareOrTheDearestJob) {
  for (const int count : {2, 5, 16}) {
    const Plan plan = plan_of_random_jobs(200);
    double all = 0, dearest = 0, busiest = 0;
    for (const PlannedJob& job : plan.jobs)
      if (job.selected) {
        all += seconds_of(job);
        dearest = std::max(dearest, seconds_of(job));
      }
    for (int i = 1; i <= count; ++i) {
      Plan part = plan;
      select_shard(part, {i, count});
      double seconds = 0;
      for (const PlannedJob& job : part.jobs) seconds += job.selected ? seconds_of(job) : 0;
      busiest = std::max(busiest, seconds);
    }
    EXPECT_LE(busiest, 4.0 / 3 * std::max(all / count, dearest)) << count;
  }
}

}  // namespace
}  // namespace gramloom
