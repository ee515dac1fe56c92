#include "core/control_group.h"

#include <fstream>
#include <limits>
#include <string>

namespace gramloom {

namespace {

constexpr const char* root = "/sys/fs/cgroup";

// Two numbers, in microseconds; "max", −1 and what can't be read are no quota.
double ratio(std::istream& quota_file, std::istream& period_file) {
  double quota = 0, period = 0;
  if (quota_file >> quota && period_file >> period && quota > 0 && period > 0)
    return quota / period;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<std::filesystem::path> control_groups() {
  std::vector<std::filesystem::path> folders;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    for (std::string path = line.substr(3);; path.erase(path.rfind('/'))) {
      folders.emplace_back(root + path);
      if (path.find('/') == std::string::npos) break;
    }
  }
  return folders;
}

double core_quota(const std::filesystem::path& folder) {
  if (std::ifstream both(folder / "cpu.max"); both) return ratio(both, both);
  std::ifstream quota(folder / "cpu.cfs_quota_us"), period(folder / "cpu.cfs_period_us");
  return ratio(quota, period);
}

}  // namespace gramloom
