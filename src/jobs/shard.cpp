#include "jobs/shard.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <queue>
#include <vector>

#include "core/error.h"

namespace gramloom {

namespace {

constexpr int most_shards = 100000;
constexpr double seconds_of_any_job = 0.01;  // reading and writing its files

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

int environment_number(const char* name, std::optional<int> otherwise = std::nullopt) {
  const char* text = std::getenv(name);
  if (!text && otherwise) return *otherwise;
  if (!text)
    throw Error("{} is not set: give the shard as 3/16, or run in a Slurm array (sbatch --array)",
                name);
  const auto number = whole_number(text);
  if (!number) throw Error("{}={} is no whole number", name, text);
  return *number;
}

Shard checked(int index, int count, const std::string& text) {
  if (count < 1 || count > most_shards || index < 1 || index > count)
    throw Error("{} is no shard: a shard K of N is K/N, with K from 1 to N and N at most {}", text,
                most_shards);
  return {index, count};
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return checked(0, 0, "'" + text + "'");
  const std::string_view whole = text;
  return checked(whole_number(whole.substr(0, slash)).value_or(0),
                 whole_number(whole.substr(slash + 1)).value_or(0), "'" + text + "'");
}

Shard shard_of_slurm() {
  const int id = environment_number("SLURM_ARRAY_TASK_ID");
  const int count = environment_number("SLURM_ARRAY_TASK_COUNT");
  const int first = environment_number("SLURM_ARRAY_TASK_MIN", 1);
  const int step = std::max(1, environment_number("SLURM_ARRAY_TASK_STEP", 1));
  if ((id - first) % step != 0)
    throw Error("SLURM_ARRAY_TASK_ID={} is none of an array from {} by {}", id, first, step);
  return checked((id - first) / step + 1, count,
                 fmt::format("task {} of {} from {} by {}", id, count, first, step));
}

double seconds_of(const PlannedJob& job) {
  return seconds_of_any_job + seconds(job.cost.work + job.finishing.work + job.scoring.work);
}

void select_shard(Plan& plan, const Shard& shard) {
  std::vector<PlannedJob*> jobs;
  for (PlannedJob& planned : plan.jobs)
    if (planned.selected) jobs.push_back(&planned);
  std::stable_sort(jobs.begin(), jobs.end(), [](const PlannedJob* a, const PlannedJob* b) {
    return seconds_of(*a) > seconds_of(*b);
  });
  struct Load {
    double seconds;
    int shard;
    bool operator>(const Load& other) const {
      return std::pair(seconds, shard) > std::pair(other.seconds, other.shard);
    }
  };
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int i = 1; i <= shard.count; ++i) loads.push({0, i});
  for (PlannedJob* planned : jobs) {
    Load least = loads.top();
    loads.pop();
    planned->selected = least.shard == shard.index;
    least.seconds += seconds_of(*planned);
    loads.push(least);
  }
}

}  // namespace gramloom
