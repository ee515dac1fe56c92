#include "jobs/agree_on_alpha.h"

#include <algorithm>

#include "core/error.h"

namespace gramloom {

namespace {

bool has_alpha(const PictureFiles& picture) {
  return layers_of({picture.files.front()}).back().kind == MapKind::alpha;
}

void add_note(PictureFiles& picture, std::string_view done, const PictureFiles& other) {
  picture.notes.push_back(fmt::format("{}: {} {}", picture.file.filename().string(), done,
                                      other.file.filename().string()));
}

void make_opaque(PictureFiles& picture) {
  Image& image = picture.images.front();
  ExemplarFile& file = picture.files.front();
  Image wider(image.size(), image.channels + 1, 1.0f);
  for (std::size_t p = 0; p < pixel_count(image.size()); ++p)
    std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(p * to_size(image.channels)),
                image.channels,
                wider.pixels.begin() + static_cast<std::ptrdiff_t>(p * to_size(wider.channels)));
  image = std::move(wider);
  ++file.channels;
  if (!file.encoding.channel_names.empty()) file.encoding.channel_names.emplace_back("A");
}

void check_opaque(const PictureFiles& picture, const Image& mask, const PictureFiles& filled,
                  const std::string& place) {
  const Image& image = picture.images.front();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y)[image.channels - 1] <= 0.5f && (mask.empty() || *mask.at(x, y) > 0.5f))
        throw ConfigError(
            "{}: {} is transparent at ({}, {}), and {}, which is filled, has no alpha: an exemplar "
            "of a config with mask = \"alpha\" is used where it is opaque",
            place, picture.file.string(), x, y, filled.file.string());
}

void drop_alpha(PictureFiles& picture) {
  Image& image = picture.images.front();
  ExemplarFile& file = picture.files.front();
  image = extract_channels(image, 0, image.channels - 1);
  --file.channels;
  if (!file.encoding.channel_names.empty()) file.encoding.channel_names.pop_back();
}

}  // namespace

void agree_on_alpha(std::vector<PictureFiles>& pictures, const std::vector<Image>& masks,
                    bool fills, const std::string& place) {
  const auto with = std::ranges::find_if(pictures, has_alpha);
  if (with == pictures.end()) return;
  const PictureFiles& filled = pictures.back();
  if (fills && !has_alpha(filled)) {
    for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
      if (!has_alpha(pictures[i]) ||
          pictures[i].files.front().channels != filled.files.front().channels + 1)
        continue;
      check_opaque(pictures[i], masks[i], filled, place);
      drop_alpha(pictures[i]);
      add_note(pictures[i], "used without its alpha, as", filled);
    }
    return;
  }
  for (PictureFiles& picture : pictures) {
    // Others differ in their colours, too.
    const int colours = with->files.front().channels - 1;
    if (has_alpha(picture) || picture.files.front().channels != colours) continue;
    make_opaque(picture);
    add_note(picture, "taken as opaque beside", *with);
  }
}

}  // namespace gramloom
