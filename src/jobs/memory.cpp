#include "jobs/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "core/control_group.h"

namespace gramloom {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

// The number after `label` in a file of "label number" lines, such as /proc/meminfo.
double labelled_number(const std::string& path, const std::string& label, double otherwise) {
  std::ifstream file(path);
  for (std::string word; file >> word;)
    if (word == label) {
      double number = otherwise;
      file >> number;
      return number;
    }
  return otherwise;
}

// The number that a file holds alone; "max" and files that are not there are `otherwise`.
double lone_number(const std::string& path, double otherwise) {
  std::ifstream file(path);
  double number = 0;
  return file >> number ? number : otherwise;
}

// What is left in one control group: limit − used, where the cache of files counts as free.
double left_in_group(const std::string& folder, const char* limit, const char* used,
                     const char* cache) {
  const double most = lone_number(folder + limit, unlimited);
  if (most == unlimited) return unlimited;
  return std::max(0.0, most - lone_number(folder + used, 0) +
                           labelled_number(folder + "/memory.stat", cache, 0));
}

// The least of the process's group (version 2) and the groups above it, and of version 1's.
double left_in_groups() {
  double left = left_in_group("/sys/fs/cgroup/memory", "/memory.limit_in_bytes",
                              "/memory.usage_in_bytes", "total_inactive_file");
  for (const auto& group : control_groups())
    left = std::min(left, left_in_group(group, "/memory.max", "/memory.current", "inactive_file"));
  return left;
}

}  // namespace

double program_memory(const Method& method) {
  // Measured, with OpenImageIO; a neural job opens LibTorch too.
  constexpr double with_pictures = 1.48e8;
  constexpr double with_networks = 2.3e8;
  return std::holds_alternative<NeuralParams>(method) ? with_networks : with_pictures;
}

double available_memory() {
  const double machine = labelled_number("/proc/meminfo", "MemAvailable:", unlimited) * 1024;
  return std::min(machine, left_in_groups());
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

double peak_memory() { return labelled_number("/proc/self/status", "VmHWM:", 0) * 1024; }

}  // namespace gramloom
