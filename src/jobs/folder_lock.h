#pragma once

#include <filesystem>
#include <optional>

#include "runs/file_lock.h"

namespace gramloom {

// Who may write into a run's folder is told by the lock run.lock in it.

/// Keeps all others out. None where the file system has no locks. Throws Error "another run is
/// writing there".
std::optional<FileLock> lock_folder(const std::filesystem::path& folder);

/// The first of those that share a folder is alone with it for a moment, to begin what they share.
struct SharedFolder {
  FileLock lock;
  bool alone = false;  // until lock.share()
};
/// Keeps those out that want a folder for themselves. Waits up to a minute for one that begins.
/// Throws Error when another keeps all out, or when the file system has no locks.
SharedFolder share_folder(const std::filesystem::path& folder);

}  // namespace gramloom
