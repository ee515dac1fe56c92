#include "jobs/keep_exemplar.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "jobs/results.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* kept_mark = "gramloom:kept";

void write_picture(const fs::path& folder, const std::string& name, const Image& image,
                   const ExemplarFile& file) {
  const OutputFormat format = output_format(Config(), file.encoding, file.channels);
  write_image(folder / (name + format.extension), image, format.encoding,
              file.kind == MapKind::normal ? green_metadata(file.green) : Metadata());
  for (const std::string extension : {".png", ".exr", ".tif"})
    if (extension != format.extension) remove_file(folder / (name + extension));
}

// `hue`: 0 to 1, once round.
std::array<float, 3> colour_of_hue(double hue) {
  std::array<float, 3> colour{};
  for (int c = 0; c < 3; ++c) {
    const double distance = std::abs(std::fmod(hue * 6 + 2 * c, 6.0) - 3);
    colour[static_cast<std::size_t>(c)] =
        static_cast<float>(0.15 + 0.75 * std::clamp(distance - 1, 0.0, 1.0));
  }
  return colour;
}

// A colour for each channel, far from those before it.
std::array<float, 3> colour_of(int channel) {
  constexpr double golden = 0.61803398875;
  return colour_of_hue(std::fmod(0.05 + golden * channel, 1.0));
}

// One channel of Target::turn; none where it is the same all over.
Image channel_of_turn(const Image& turn, int channel) {
  if (turn.empty()) return {};
  Image values = extract_channels(turn, channel, 1);
  const auto [low, high] = std::ranges::minmax(values.pixels);
  return low < high ? values : Image();
}

// Turns as hues: the same after each full one.
Image shown_angles(const Image& turn) {
  const Image turns = channel_of_turn(turn, 0);
  if (turns.empty()) return {};
  Image result(turns.size(), 3);
  for (std::size_t p = 0; p < turns.pixels.size(); ++p) {
    const double t = static_cast<double>(turns.pixels[p]);
    std::ranges::copy(colour_of_hue(t - std::floor(t)),
                      result.pixels.begin() + static_cast<std::ptrdiff_t>(3 * p));
  }
  return result;
}

// Shares of channels as a mixture of their colours; other values from black to white.
Image shown(const Image& guide) {
  const bool shares =
      guide.channels > 1 && std::ranges::all_of(guide.pixels, [](float v) { return v >= 0; });
  Image result(guide.size(), 3);
  const auto [low, high] = std::ranges::minmax(guide.pixels);
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x) {
      const float* from = guide.at(x, y);
      float* to = result.at(x, y);
      float sum = 0;
      for (int c = 0; c < guide.channels; ++c) sum += from[c];
      for (int c = 0; c < guide.channels; ++c)
        for (std::size_t k = 0; k < 3; ++k)
          to[k] += shares ? from[c] / std::max(sum, 1e-6f) * colour_of(c)[k]
                          : (from[c] - low) / std::max(high - low, 1e-6f) /
                                static_cast<float>(guide.channels);
    }
  return result;
}

// What is not there any more is removed: of a config that had it before.
void write_or_remove(const fs::path& file, const Image& image) {
  if (!image.empty())
    write_image(file, image, {}, {{kept_mark, "yes"}});
  else if (is_kept(file))
    remove_file(file);
}

Image shown_or_none(const Image& guide, Size least) {
  return guide.empty() || guide.width < least.width ? Image() : shown(guide);
}

}  // namespace

bool is_kept(const fs::path& file) {
  try {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && read_image(file).metadata.contains(kept_mark);
  } catch (const Error&) {
    return false;
  }
}

void write_exemplar(const fs::path& folder, const Request& request,
                    const std::vector<ExemplarFile>& files) {
  for (std::size_t i = 0; i < request.exemplars.size(); ++i) {
    const Exemplar& exemplar = request.exemplars[i];
    const Texture parts = split_layers({exemplar.image}, files);
    const std::string stem = kept_stem(i);
    for (const ExemplarFile& file : files)
      write_picture(folder, file.map.empty() ? stem : fmt::format("{}_{}", stem, file.map),
                    file.map.empty() ? parts.image : parts.maps.at(file.map), file);
    write_or_remove(folder / (stem + "_usable.png"), exemplar.mask);
    write_or_remove(folder / (stem + "_guide.png"), shown_or_none(exemplar.guide, {}));
  }
  const Target& target = request.target;
  write_or_remove(folder / "target_guide.png", shown_or_none(target.guide, {}));
  // Of weights that are the same everywhere there is no picture.
  write_or_remove(folder / "target_weights.png", shown_or_none(target.weights, {2, 1}));
  write_or_remove(folder / "target_mask.png", target.mask);
  write_or_remove(folder / "target_angle.png", shown_angles(target.turn));
  write_or_remove(folder / "target_scale.png", shown_or_none(channel_of_turn(target.turn, 1), {}));
}

std::vector<std::string> kept_files(const ExemplarEntry& exemplar) {
  std::vector<std::string> names;
  const std::size_t pictures = 1 + exemplar.more.size();
  for (std::size_t i = 0; i < pictures; ++i) {
    const std::string stem = kept_stem(i);
    names.push_back(stem);
    for (const auto& [map, file] : exemplar.maps) names.push_back(stem + "_" + map);
  }
  return names;
}

std::vector<std::string> kept_directions(const ExemplarEntry& exemplar) {
  std::vector<std::string> names{"target_guide", "target_weights", "target_mask", "target_angle",
                                 "target_scale"};
  const std::size_t pictures = 1 + exemplar.more.size();
  for (std::size_t i = 0; i < pictures; ++i)
    for (const char* what : {"_usable", "_guide"}) names.push_back(kept_stem(i) + what);
  return names;
}

}  // namespace gramloom
