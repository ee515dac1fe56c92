#include "jobs/loaded_request.h"

#include <algorithm>
#include <cmath>

#include "io/without_alpha.h"
#include "jobs/agree_on_alpha.h"
#include "jobs/filling.h"
#include "jobs/guides.h"
#include "jobs/memory.h"
#include "jobs/picture_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// 1 what of a picture may be used; empty: all.
Image mask_of(const ExemplarPicture& entry, const PictureFiles& picture, const std::string& place) {
  if (entry.mask.empty()) return {};
  Image mask = read_mask(entry.mask, picture, "the mask", place);
  if (std::ranges::count(mask.pixels, 1.0f) == 0)
    throw ConfigError("{}: the mask {} is black everywhere: nothing of {} may be used", place,
                      entry.mask.string(), picture.file.string());
  return mask;
}

Exemplar exemplar_of(const ExemplarPicture& entry, PictureFiles picture, Image mask,
                     const std::string& place) {
  Exemplar exemplar;
  exemplar.layers = layers_of(picture.files);
  exemplar.mask = std::move(mask);
  if (!entry.guide.empty())
    exemplar.guide = without_alpha(read_sized(entry.guide, picture.images.front().size(),
                                              "the guide", picture.file.string(), place));
  exemplar.image = joined(std::move(picture));
  return exemplar;
}

void check_weights(const Image& weights, const MixEntry& mix, const std::string& place) {
  for (int y = 0; y < weights.height; ++y)
    for (int x = 0; x < weights.width; ++x)
      if (std::all_of(weights.at(x, y), weights.at(x, y) + weights.channels,
                      [](float v) { return v <= 0; }))
        throw ConfigError("{}: at ({}, {}) the weights are all 0, by {}", place, x, y,
                          mix.images.empty() ? "'weights'" : mix.images.front().string());
}

// The texture's weights of `count` exemplars, for those that have any.
Image weights_of(const MixEntry& mix, std::size_t count, Size size, const std::string& place) {
  const int channels = static_cast<int>(count);
  if (!mix.weights.empty()) {
    Image weights(1, 1, channels);
    std::ranges::transform(mix.weights, weights.pixels.begin(),
                           [](double w) { return static_cast<float>(w); });
    return weights;
  }
  Image weights(size, channels);
  const bool two_in_one = mix.images.size() == 1 && count == 2;
  for (std::size_t i = 0; i < mix.images.size(); ++i) {
    const Image picture =
        brightness(read_sized(mix.images[i], size, "the weights", "the texture", place));
    for (std::size_t p = 0; p < picture.pixels.size(); ++p) {
      float* to = weights.pixels.data() + p * count;
      if (two_in_one) to[0] = 1 - picture.pixels[p];
      to[two_in_one ? 1 : i] = picture.pixels[p];
    }
  }
  check_weights(weights, mix, place);
  return weights;
}

// Leaves out the exemplars that have no weight anywhere, and their guides' names.
void drop_weightless(std::vector<Exemplar>& exemplars, std::vector<fs::path>& guides,
                     Image& weights) {
  const auto count = static_cast<std::size_t>(weights.channels);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; ++i) {
    bool any = false;
    for (std::size_t p = i; p < weights.pixels.size(); p += count) any |= weights.pixels[p] > 0;
    if (any) kept.push_back(i);
  }
  if (kept.size() == count) return;
  Image rest(weights.size(), static_cast<int>(kept.size()));
  std::vector<Exemplar> left;
  std::vector<fs::path> names;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    left.push_back(std::move(exemplars[kept[k]]));
    if (!guides.empty()) names.push_back(guides[kept[k]]);
    for (std::size_t p = 0; p * count < weights.pixels.size(); ++p)
      rest.pixels[p * kept.size() + k] = weights.pixels[p * count + kept[k]];
  }
  exemplars = std::move(left);
  guides = std::move(names);
  weights = kept.size() == 1 ? Image() : std::move(rest);
}

// Turns in the first channel, the logarithm of scales in the second.
Image turn_of(const TurnEntry& turn, Size size, const std::string& place) {
  Image result(size, 2);
  const auto read = [&](const fs::path& file, const std::string& what, int channel, double black,
                        double white) {
    if (file.empty()) return;
    const Image picture = brightness(read_sized(file, size, what, "the texture", place));
    for (std::size_t p = 0; p < picture.pixels.size(); ++p)
      result.pixels[2 * p + static_cast<std::size_t>(channel)] =
          static_cast<float>(black + (white - black) * static_cast<double>(picture.pixels[p]));
  };
  read(turn.angle, "the angles", 0, turn.angles[0] / 360, turn.angles[1] / 360);
  read(turn.scale, "the scales", 1, std::log2(turn.scales[0]), std::log2(turn.scales[1]));
  return result;
}

// What a picture is extended to is in memory before anything else is known.
void check_canvas(const Config& config) {
  if (!config.direction.fill) return;
  const double bytes = 20.0 * config.size.width * config.size.height;
  if (const double free = available_memory(); bytes > free)
    throw Error("a picture of {}×{} pixels needs about {:.1f} GB of memory, {:.1f} GB are free",
                config.size.width, config.size.height, bytes / 1e9, free / 1e9);
}

void shrink_all(const ExemplarEntry& entry, std::vector<Exemplar>& exemplars) {
  for (Exemplar& exemplar : exemplars) {
    shrink(exemplar, *entry.max_side);
    if (!exemplar.mask.empty() && std::ranges::count(exemplar.mask.pixels, 1.0f) == 0)
      throw ConfigError("{}: at max_side = {} nothing of {} is left that its mask lets be used",
                        entry.place, *entry.max_side, entry.image.string());
  }
}

}  // namespace

std::string place_of(const Config& config, std::string_view section) {
  return fmt::format("{}: [{}]", config.file.string(), section);
}

LoadedRequest load_request(const Config& config, std::optional<std::size_t> number) {
  LoadedRequest loaded;
  loaded.target = {config.size, config.tile};
  if (!number) return loaded;
  check_canvas(config);
  const ExemplarEntry& entry = config.exemplars[*number];
  const Direction& direction = config.direction;

  // The picture that is filled is read with the exemplar's: their maps have one range.
  std::vector<ExemplarPicture> entries;
  if (!entry.is_filled) entries = pictures_of(entry);
  std::vector<PictureFiles> pictures;
  std::vector<Image> masks;
  for (const ExemplarPicture& picture : entries) {
    pictures.push_back(read_picture(picture, entry.place));
    masks.push_back(mask_of(picture, pictures.back(), entry.place));
  }
  if (direction.fill)
    pictures.push_back(read_picture({direction.fill->image, direction.fill->maps, {}, {}},
                                    place_of(config, "fill")));
  agree_on_alpha(pictures, masks, direction.fill.has_value(), entry.place);
  fit_together(pictures, entry.place);
  loaded.files = direction.fill ? pictures.back().files : pictures.front().files;
  for (const PictureFiles& picture : pictures)
    loaded.notes.insert(loaded.notes.end(), picture.notes.begin(), picture.notes.end());

  for (std::size_t i = 0; i < entries.size(); ++i)
    loaded.exemplars.push_back(
        exemplar_of(entries[i], std::move(pictures[i]), std::move(masks[i]), entry.place));
  if (direction.fill) {
    loaded.metadata = pictures.back().metadata;
    std::erase_if(loaded.metadata, [](const auto& text) {  // ours are of how it was made
      return text.first.starts_with("gramloom:");
    });
    if (entry.is_filled) loaded.filled_at = corner_of(*direction.fill);
    Filling filling = filling_of(*direction.fill, pictures.back(), config.size, entry.is_filled,
                                 place_of(config, "fill"));
    if (entry.is_filled)
      loaded.exemplars.push_back(
          {joined(std::move(pictures.back())), layers_of(loaded.files), std::move(filling.usable)});
    loaded.target.known = std::move(filling.known);
    loaded.target.mask = std::move(filling.mask);
    loaded.target.blend = direction.fill->blend;
  }
  std::vector<fs::path> guides;
  for (const ExemplarPicture& picture : entries) guides.push_back(picture.guide);
  if (direction.mix) {
    loaded.target.weights =
        weights_of(*direction.mix, loaded.exemplars.size(), config.size, place_of(config, "mix"));
    drop_weightless(loaded.exemplars, guides, loaded.target.weights);
  }
  if (direction.guide) add_guides(config, guides, loaded.exemplars, loaded.target);
  if (entry.max_side) shrink_all(entry, loaded.exemplars);
  if (direction.turn)
    loaded.target.turn = turn_of(*direction.turn, config.size, place_of(config, "turn"));
  return loaded;
}

}  // namespace gramloom
