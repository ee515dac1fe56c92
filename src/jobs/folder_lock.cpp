#include "jobs/folder_lock.h"

#include <chrono>
#include <string>
#include <thread>

#include "core/error.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto patience = 60s;  // for another to begin, or for a report
constexpr auto pause = 20ms;

fs::path lock_of(const fs::path& folder) { return folder / "run.lock"; }

[[noreturn]] void refuse(const fs::path& folder) {
  const std::string holder = holder_of(lock_of(folder));
  throw Error("another run is writing there{}", holder.empty() ? "" : " (" + holder + ")");
}

}  // namespace

std::optional<FileLock> lock_folder(const fs::path& folder) {
  std::optional<FileLock> lock;
  try {
    lock = FileLock::take(lock_of(folder), FileLock::Mode::exclusive);
  } catch (const Error&) {
    return std::nullopt;  // a folder that cannot be written is named by what is written first
  }
  if (!lock) refuse(folder);
  return lock;
}

SharedFolder share_folder(const fs::path& folder) {
  const auto end = std::chrono::steady_clock::now() + patience;
  do {
    if (auto lock = FileLock::take(lock_of(folder), FileLock::Mode::exclusive))
      return {std::move(*lock), true};
    if (auto lock = FileLock::take(lock_of(folder), FileLock::Mode::shared))
      return {std::move(*lock), false};
    std::this_thread::sleep_for(pause);
  } while (std::chrono::steady_clock::now() < end);
  refuse(folder);
}

}  // namespace gramloom
