#include "jobs/folder_lock.h"

#include <chrono>
#include <string>

#include "core/error.h"
#include "core/polling.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds patience{60};  // for another to begin, or for a report

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
  std::optional<FileLock> lock;
  bool alone = false;
  const bool taken = comes_true(patience, [&] {
    lock = FileLock::take(lock_of(folder), FileLock::Mode::exclusive);
    alone = lock.has_value();
    if (!lock) lock = FileLock::take(lock_of(folder), FileLock::Mode::shared);
    return lock.has_value();
  });
  if (!taken) refuse(folder);
  return {std::move(*lock), alone};
}

}  // namespace gramloom
