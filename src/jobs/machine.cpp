#include "jobs/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "core/build_stamp.h"
#include "core/threads.h"

namespace gramloom {

namespace {

// The rest of the first line of `path` that begins with `label`, after its colon.
std::string labelled_line(const std::string& path, std::string_view label) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(label)) {
      const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
      return start == std::string::npos ? "" : line.substr(start);
    }
  return "";
}

}  // namespace

std::string_view version() { return GRAMLOOM_VERSION; }

std::string version_line() {
  return fmt::format("gramloom {} (build {})", version(), build_stamp());
}

Named<std::string> versions() {
  Named<std::string> versions{{"gramloom", std::string(version())}};
  // "name version,name version", from CMake.
  std::string_view list = GRAMLOOM_LIBRARY_VERSIONS;
  while (!list.empty()) {
    const std::string_view one = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), one.size() + 1));
    const std::size_t space = one.find(' ');
    versions.emplace_back(one.substr(0, space), one.substr(space + 1));
  }
  return versions;
}

Machine machine() {
  return {labelled_line("/proc/cpuinfo", "model name"),
          static_cast<int>(std::thread::hardware_concurrency()), thread_count(),
          labelled_line("/proc/meminfo", "MemTotal")};
}

}  // namespace gramloom
