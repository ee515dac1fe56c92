#include "jobs/read_direction.h"

#include <algorithm>

#include "io/toml_reader.h"
#include "jobs/exemplar_entries.h"
#include "jobs/overrides.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

void check_pair(const std::vector<double>& values, const toml::table& table, std::string_view key) {
  if (values.size() != 2)
    fail(key_region(table, key), "'{}' has {} {}: it must be two, for black and for white", key,
         values.size(), values.size() == 1 ? "number" : "numbers");
}

void check_entry(const GuideEntry&, const toml::table& table) { required_text(table, "image"); }

void check_entry(const MixEntry& mix, const toml::table& table) {
  if (mix.weights.empty() == mix.images.empty())
    fail(table.source(), "[mix] needs 'weights' or 'images', and not both");
  if (!mix.weights.empty() && std::ranges::all_of(mix.weights, [](double w) { return w == 0; }))
    fail(key_region(table, "weights"), "'weights' are all 0");
}

void check_entry(const TurnEntry& turn, const toml::table& table) {
  if (turn.angle.empty() && turn.scale.empty())
    fail(table.source(), "[turn] needs 'angle' or 'scale', or both");
  for (const auto& [key, file] : {std::pair{"angles", &turn.angle}, {"scales", &turn.scale}})
    if (table.contains(key) && file->empty())
      fail(key_region(table, key), "'{}' without a picture of them does nothing", key);
  check_pair(turn.angles, table, "angles");
  check_pair(turn.scales, table, "scales");
}

void check_entry(FillEntry& fill, const toml::table& table) {
  required_text(table, "image");
  check_maps(fill.maps, key_region(table, "maps"));
  check_mask(fill.mask, key_region(table, "mask"));
  if (fill.extend.size() == 1) fill.extend.assign(4, fill.extend.front());
  if (!fill.extend.empty() && fill.extend.size() != 4)
    gramloom::fail(key_region(table, "extend"),
                   "'extend' has {} numbers: it must be one for all sides, or left, top, right and "
                   "bottom",
                   fill.extend.size());
  if (fill.band > 0 && fill.seamless == Tile::none)
    gramloom::fail(key_region(table, "band"), "'band' without 'seamless' does nothing");
  if (fill.mask.empty() && fill.seamless == Tile::none &&
      std::ranges::all_of(fill.extend, [](int side) { return side == 0; }))
    gramloom::fail(table.source(),
                   "[fill] makes nothing anew: it needs 'mask', 'seamless' or 'extend'");
}

Size size_of_picture(const fs::path& file, const toml::source_region& region) {
  try {
    return read_image(file).image.size();
  } catch (const Error& error) {
    fail(region, "{}", error.what());
  }
}

// Of the pictures that are as large as the texture, the first.
std::optional<Size> size_of_maps(const Direction& direction, toml::table& table) {
  const auto of = [&](const fs::path& file, std::string_view section, std::string_view key) {
    return size_of_picture(file, key_region(*single_section(table, section), key));
  };
  if (direction.guide) return of(direction.guide->image, "guide", "image");
  if (direction.mix && !direction.mix->images.empty())
    return of(direction.mix->images.front(), "mix", "images");
  if (direction.turn && !direction.turn->angle.empty())
    return of(direction.turn->angle, "turn", "angle");
  if (direction.turn) return of(direction.turn->scale, "turn", "scale");
  return std::nullopt;
}

// The picture itself, what is to be made anew left out.
ExemplarEntry filled_exemplar(const FillEntry& fill, const toml::table& table) {
  ExemplarEntry exemplar;
  exemplar.name = fill.image.stem().string();
  try {
    check_exemplar_name(exemplar.name, table.source());
  } catch (const ConfigError&) {
    exemplar.name = "picture";  // a file's name may have what a folder's may not
  }
  exemplar.image = fill.image;
  exemplar.maps = fill.maps;
  exemplar.is_filled = true;
  exemplar.place = place(table.source());
  return exemplar;
}

void follow_fill(Config& config, toml::table& table) {
  const FillEntry& fill = *config.direction.fill;
  const toml::table& section = *single_section(table, "fill");
  if (table.contains("size"))
    gramloom::fail(key_region(table, "size"),
                   "with [fill] the results have the size of its picture: leave 'size' out");
  if (table.contains("pixel_type"))
    gramloom::fail(key_region(table, "pixel_type"),
                   "with [fill] the results have the pixel type of its picture: leave it out");
  if (config.format == FileFormat::jpg)
    gramloom::fail(key_region(table, "format"),
                   "a jpg does not keep what [fill] leaves as it is: choose another format");
  config.size = size_of_picture(fill.image, key_region(section, "image"));
  if (!fill.extend.empty()) {
    config.size.width += fill.extend[0] + fill.extend[2];
    config.size.height += fill.extend[1] + fill.extend[3];
    if (std::max(config.size.width, config.size.height) > longest_side)
      gramloom::fail(key_region(section, "extend"),
                     "'extend' makes it {}×{} pixels: a side has at most {}", config.size.width,
                     config.size.height, longest_side);
  }
  if (fill.seamless != Tile::none) {
    if (table.contains("tile") && config.tile != fill.seamless)
      gramloom::fail(key_region(table, "tile"), "'tile' and 'seamless' of [fill] differ");
    config.tile = fill.seamless;
  }
  if (config.exemplars.empty()) config.exemplars = {filled_exemplar(fill, section)};
}

void check_mix(const Config& config, toml::table& table) {
  const MixEntry& mix = *config.direction.mix;
  const toml::table& section = *single_section(table, "mix");
  for (const ExemplarEntry& exemplar : config.exemplars) {
    const std::size_t pictures = 1 + exemplar.more.size();
    if (pictures == 1)
      fail(section.source(), "[mix] needs several 'images': the exemplar '{}' is one picture",
           exemplar.name);
    const bool weights = !mix.weights.empty();
    const std::size_t count = weights ? mix.weights.size() : mix.images.size();
    if (count == pictures || (!weights && count == 1 && pictures == 2)) continue;
    fail(key_region(section, weights ? "weights" : "images"),
         "{} {} for the {} {} of the exemplar '{}': one for each is needed", count,
         weights ? "weights" : "pictures of weights", pictures,
         pictures == 1 ? "picture" : "pictures", exemplar.name);
  }
}

// Each picture of an exemplar says where it belongs, or there is no guide.
void check_guides(const Config& config) {
  for (const ExemplarEntry& exemplar : config.exemplars)
    for (const ExemplarPicture& picture : pictures_of(exemplar)) {
      if (exemplar.is_filled) continue;
      if (config.direction.guide && picture.guide.empty())
        throw ConfigError("{}: the exemplar '{}' has no 'guide' for {}: [guide] needs one",
                          exemplar.place, exemplar.name, picture.image.string());
      if (!config.direction.guide && !picture.guide.empty())
        throw ConfigError("{}: the exemplar '{}' has a 'guide', and there is no [guide]",
                          exemplar.place, exemplar.name);
    }
}

}  // namespace

Direction read_direction(toml::table& config) {
  Direction direction;
  for_each_direction(direction, [&]<class Entry>(std::optional<Entry>& entry) {
    const toml::table* table = single_section(config, Entry::section);
    if (!table) return;
    check_keys(*table, key_names<Entry>());
    entry.emplace();
    read_fields(*entry, *table);
    check_entry(*entry, *table);
  });
  return direction;
}

void follow_direction(Config& config, toml::table& table) {
  const Direction& direction = config.direction;
  if (direction.fill && direction.guide && config.exemplars.empty())
    fail(key_region(table, "guide"),
         "[guide] with [fill] needs an [[exemplar]] with a 'guide': the picture has none");
  if (direction.fill)
    follow_fill(config, table);
  else if (const auto size = size_of_maps(direction, table); size && !table.contains("size"))
    config.size = *size;
  if (direction.mix) check_mix(config, table);
  if (direction.turn && config.coordinates)
    fail(key_region(table, "coordinates"),
         "[turn] makes pixels that are between the exemplar's: there are no coordinates of them");
  if (direction.fill && direction.fill->blend > 0 && config.coordinates)
    fail(key_region(table, "coordinates"),
         "[fill] blends what is copied into what stays (blend = {}), and there are no coordinates "
         "of blends: allowed with coordinates is blend = 0",
         direction.fill->blend);
  check_guides(config);
}

}  // namespace gramloom
