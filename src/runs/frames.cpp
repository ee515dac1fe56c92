#include "runs/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/image_file.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// "frame_0001.exr": of the file types that sequences have.
bool is_frame(const fs::path& file) {
  constexpr auto extensions = std::to_array<std::string_view>({".exr", ".tif", ".png", ".jpg"});
  constexpr std::string_view before = "frame_";
  const std::string stem = file.stem().string();
  return stem.size() == before.size() + 4 && stem.starts_with(before) &&
         std::all_of(stem.begin() + before.size(), stem.end(),
                     [](unsigned char c) { return c >= '0' && c <= '9'; }) &&
         std::ranges::find(extensions, file.extension().string()) != extensions.end();
}

bool bears_mark(const fs::path& file) {
  try {
    return read_image(file).metadata.contains(inferred_mark);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<fs::path> frame_files(const fs::path& folder, std::size_t count,
                                  const std::string& format) {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < count; ++i)
    files.push_back(folder / fmt::format("frame_{:04}.{}", i + 1, format));
  return files;
}

std::vector<fs::path> frames_in(const fs::path& folder) {
  std::vector<fs::path> frames;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (is_frame(entry.path()) && entry.is_regular_file(ignored)) frames.push_back(entry.path());
  std::ranges::sort(frames);
  return frames;
}

void remove_earlier_frames(const std::vector<fs::path>& frames) {
  for (const fs::path& file : frames_in(frames.front().parent_path()))
    if (std::ranges::find(frames, file) == frames.end() && bears_mark(file)) remove_file(file);
}

}  // namespace gramloom
