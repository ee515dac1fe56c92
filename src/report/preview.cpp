#include "report/preview.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

bool is_linear(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.starts_with("lin") || name == "scene_linear";
}

float srgb_curve(float v) {
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

void create_folders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error("cannot make the folder {}: {}", folder.string(), error.message());
}

}  // namespace

fs::file_time_type newest_time(const std::vector<fs::path>& files) {
  auto newest = fs::file_time_type::min();
  std::error_code ignored;
  for (const fs::path& file : files) newest = std::max(newest, fs::last_write_time(file, ignored));
  return newest;
}

bool has_time(const fs::path& file, fs::file_time_type time) {
  std::error_code error;
  return fs::last_write_time(file, error) == time && !error;
}

void set_time(const fs::path& file, fs::file_time_type time) {
  std::error_code ignored;  // then it is made again the next time
  fs::last_write_time(file, time, ignored);
}

double white_of(const ImageFile& file) {
  const PixelType type = file.encoding.pixel_type;
  if (type != PixelType::half && type != PixelType::float32) return 1;
  std::vector<float> values = file.image.pixels;
  if (values.empty()) return 1;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return std::max(1.0, static_cast<double>(*place));
}

Image preview(const ImageFile& file, double white) {
  const int channels = file.image.channels;
  const bool alpha = channels == 2 || channels == 4;
  Image image = channels > 4 ? extract_channels(file.image, 0, 3) : file.image;
  const bool linear = is_linear(file.encoding.colour_space);
  const auto count = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (alpha && i % count == count - 1) continue;
    const float v = std::clamp(image.pixels[i] / static_cast<float>(white), 0.0f, 1.0f);
    image.pixels[i] = linear ? srgb_curve(v) : v;
  }
  return image;
}

bool browsers_show(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

fs::path preview_file(const fs::path& file) {
  fs::path preview = file.begin() != file.end() && *file.begin() == "page" ? file : "page" / file;
  return preview += ".png";
}

std::string shown_file(const fs::path& folder, const std::string& file, double white) {
  if (!fs::is_regular_file(folder / file)) throw Error("{} is not there", file);
  if (browsers_show(file)) return file;
  const fs::path shown = preview_file(file);
  const auto time = newest_time({folder / file});
  if (!has_time(folder / shown, time)) {
    create_folders((folder / shown).parent_path());
    write_image(folder / shown, preview(read_image(folder / file), white), {});
    set_time(folder / shown, time);
  }
  return shown.generic_string();
}

}  // namespace gramloom
