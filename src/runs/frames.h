#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gramloom {

// The pictures of a sequence that an inference makes: frame_0001.exr … in a folder of their own.

/// In the metadata of every picture that is inferred: its pose.
inline constexpr const char* inferred_mark = "gramloom:inferred";

/// The files of so many frames in the folder.
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder,
                                               std::size_t count, const std::string& format);

/// The frames that are in the folder, in their order.
std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder);

/// Removes what a longer sequence, or one of another format, has left beside `frames`: frames that
/// bear the mark. Others are not ours and stay.
void remove_earlier_frames(const std::vector<std::filesystem::path>& frames);

}  // namespace gramloom
