#include "report/sequence_view.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "io/image_file.h"
#include "report/preview.h"
#include "runs/frames.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view folder_end = "_frames";

struct Frame {
  fs::path file;  // from the run's folder on
  Image picture;
  Json pose;
};

std::vector<Frame> read_frames(const fs::path& run, const fs::path& folder) {
  std::vector<Frame> frames;
  for (const fs::path& file : frames_in(run / folder)) {
    ImageFile read = read_image(file);
    const auto mark = read.metadata.find(inferred_mark);
    if (mark == read.metadata.end()) continue;  // none of ours
    frames.push_back({folder / file.filename(), std::move(read.image), parse_json(mark->second)});
  }
  return frames;
}

// What browsers show of a picture: its colours, or its first channel.
Image shown_channels(const Image& picture) {
  return picture.channels == 1 || picture.channels == 3
             ? picture
             : extract_channels(picture, 0, picture.channels == 4 ? 3 : 1);
}

void write_previews(const fs::path& run, const std::vector<Frame>& frames) {
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  std::vector<Image> pictures;
  for (const Frame& frame : frames) {
    pictures.push_back(shown_channels(frame.picture));
    const auto [least, largest] = std::ranges::minmax(pictures.back().pixels);
    low = std::min(low, least);
    high = std::max(high, largest);
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (float& value : pictures[i].pixels)
      value = high > low ? (value - low) / (high - low) : 0.5f;
    write_image(run / preview_file(frames[i].file), pictures[i], {});
  }
}

Json frames_to_json(const fs::path& run, const fs::path& folder) {
  const std::vector<Frame> frames = read_frames(run, folder);
  if (frames.empty()) return Json::array();
  const bool previews = !browsers_show(frames.front().file);
  if (previews) {
    create_folder((run / preview_file(frames.front().file)).parent_path());
    write_previews(run, frames);
  }
  Json list = Json::array();
  for (const Frame& frame : frames)
    list.push_back({{"file", frame.file.generic_string()},
                    {"shown", (previews ? preview_file(frame.file) : frame.file).generic_string()},
                    {"width", frame.picture.width},
                    {"height", frame.picture.height},
                    {"pose", frame.pose}});
  return list;
}

}  // namespace

Json sequence_views(const RunOnDisk& run, Json& trouble) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(run.folder / "models", ignored))
    if (entry.is_directory(ignored) && entry.path().filename().string().ends_with(folder_end))
      folders.push_back(fs::path("models") / entry.path().filename());
  std::ranges::sort(folders);
  Json views = Json::array();
  for (const fs::path& folder : folders) {
    try {
      std::string name = folder.filename().string();
      name.resize(name.size() - folder_end.size());
      Json frames = frames_to_json(run.folder, folder);
      if (!frames.empty()) views.push_back({{"name", name}, {"frames", std::move(frames)}});
    } catch (const std::exception& error) {
      trouble.push_back(message_of(error));
    }
  }
  return views;
}

}  // namespace gramloom
