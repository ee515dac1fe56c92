#pragma once

#include <filesystem>
#include <vector>

namespace gramloom {

/// The folders of the control groups (version 2) that this process is in: its own, then those
/// above it up to the root. A limit in any of them holds.
std::vector<std::filesystem::path> control_groups();

/// How many cores the group of a folder may keep busy, from cpu.max (version 2) or cpu.cfs_quota_us
/// (version 1): infinite without a quota.
double core_quota(const std::filesystem::path& folder);

}  // namespace gramloom
