#include "report/surface_view.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/field_values.h"
#include "io/image_encode.h"
#include "io/json_text.h"
#include "io/text_file.h"
#include "report/preview.h"
#include "signal/normal_colours.h"
#include "signal/resize.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr int most_pixels = 512;           // on a side
constexpr std::uintmax_t small = 400'000;  // bytes

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[group >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string data_url(const std::string& extension, std::string_view bytes) {
  return fmt::format("data:image/{};base64,{}", extension == ".png" ? "png" : "jpeg",
                     base64(bytes));
}

Image reduced(const Image& image) { return fit_longer_side(image, most_pixels); }

// 8-bit sRGB, without alpha. Made small first: the picture may be a large one.
std::string colour_url(ImageFile file, double white) {
  file.image = reduced(file.image);
  Image shown = preview(file, white);
  if (shown.channels == 2 || shown.channels == 4)
    shown = extract_channels(shown, 0, shown.channels - 1);
  return data_url(".jpg", encoded_image(".jpg", shown, {}));
}

struct PackedHeight {
  std::string url;
  double strength = 1;  // of the packed height, for a strength of 1
};

PackedHeight pack_height(const Image& map) {
  const Image height = reduced(extract_channels(map, 0, 1));
  const auto [low, high] = std::ranges::minmax(height.pixels);
  const float range = high > low ? high - low : 1;
  Image packed(height.size(), 3);
  for (std::size_t i = 0; i < height.pixels.size(); ++i) {
    const float steps = std::round((height.pixels[i] - low) / range * 65535);
    const float upper = std::floor(steps / 256);
    packed.pixels[3 * i] = upper / 255;
    packed.pixels[3 * i + 1] = (steps - 256 * upper) / 255;
  }
  return {data_url(".png", encoded_image(".png", packed, {})), static_cast<double>(range)};
}

// Whether a browser can take the file as it is.
bool is_small(const fs::path& file) {
  std::error_code ignored;
  return browsers_show(file) && fs::file_size(file, ignored) <= small;
}

Json maps_of(const fs::path& folder, const SurfaceView& view, double& strength) {
  Json maps;
  for (const auto& [name, file] : view.files) {
    const fs::path path = folder / file;
    if (name != "height" && is_small(path)) {
      maps[name] = data_url(path.extension().string(), read_text(path));
      continue;
    }
    ImageFile picture = read_image(path);
    if (name == "height") {
      const PackedHeight height = pack_height(picture.image);
      maps[name] = height.url;
      strength *= height.strength / picture.image.width;
    } else if (name == "colour") {
      maps[name] = colour_url(std::move(picture), view.white);
    } else {
      const bool normals = name == "normal" && picture.image.channels >= 3;
      const Image map = normals ? as_colours(extract_channels(picture.image, 0, 3))
                                : extract_channels(picture.image, 0, 1);
      maps[name] = data_url(".png", encoded_image(".png", reduced(map), {}));
    }
  }
  return maps;
}

}  // namespace

std::string surface_view_file(const fs::path& folder, const std::string& name,
                              const SurfaceView& view) {
  const fs::path shown = fs::path("page") / (name + ".view.js");
  std::vector<fs::path> files;
  std::string kinds;
  for (const auto& [kind, file] : view.files) {
    files.push_back(folder / file);
    kinds += kind + " ";
  }
  // What comes before the pictures, and must be as the view has it in an older script too.
  const std::string begin =
      fmt::format("surfaceData({}, {{\"tile\":\"{}\",\"green\":\"{}\",\"kinds\":\"{}\",",
                  to_text(Json(shown.generic_string()), -1, true), to_word(view.tile),
                  to_word(view.green), kinds);
  const auto time = newest_time(files);
  if (has_time(folder / shown, time) && read_text(folder / shown).starts_with(begin))
    return shown.generic_string();
  double strength = view.strength;
  const Json maps = maps_of(folder, view, strength);
  const Json data{{"strength", strength}, {"maps", maps}};
  std::error_code error;
  fs::create_directories((folder / shown).parent_path(), error);
  write_text(folder / shown, fmt::format("{}{});\n", begin, to_text(data, -1, true).substr(1)));
  set_time(folder / shown, time);
  return shown.generic_string();
}

}  // namespace gramloom
