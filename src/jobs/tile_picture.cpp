#include "jobs/tile_picture.h"

#include <algorithm>
#include <future>
#include <memory>

#include "core/error.h"
#include "io/image_rows.h"
#include "io/json_fields.h"
#include "jobs/loaded_request.h"
#include "jobs/machine.h"
#include "jobs/protected_files.h"
#include "jobs/settings.h"
#include "surface/stochastic_tiling.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// What of each tiled pixel goes to a file, and how.
struct Part {
  fs::path file;
  std::unique_ptr<ImageRows> rows;
  int first = 0, channels = 0;
  float low = 0, high = 1;  // the file's values that 0 and 1 stand for
};

void check_files(const TileWork& work) {
  std::vector<InputFile> read{{work.picture, "is to be tiled"}};
  for (const auto& [name, map] : work.maps) read.push_back({map.image, "is to be tiled"});
  const ProtectedFiles inputs(read);
  inputs.check(work.output);
  // The maps' names are ours, not the user's: only files of an earlier tiling are replaced.
  for (const auto& [name, map] : work.maps)
    check_replaced(file_of_map(work.output, name), inputs, "gramloom:settings");
}

Metadata metadata_of(const TileWork& work) {
  Json made_by{{"gramloom", version()},
               {"picture", valid_utf8(work.picture.filename().string())},
               {"size", {work.size.width, work.size.height}},
               {"tile", to_word(work.tile)},
               {"seed", work.seed},
               {"method", method_to_json(work.params, "")}};
  return {{"gramloom:settings", to_text(made_by, -1, true)}};
}

bool has_integers(const fs::path& file, PixelType type) {
  const PixelType stored = stored_type(file.extension().string(), type);
  return stored == PixelType::uint8 || stored == PixelType::uint16;
}

std::vector<Part> open_parts(const TileWork& work, const LoadedRequest& exemplar,
                             TiledFiles& tiled) {
  const Metadata metadata = metadata_of(work);
  std::vector<Part> parts;
  int first = 0;
  for (const ExemplarFile& file : exemplar.files) {
    Encoding encoding = file.encoding;
    if (work.pixel_type) encoding.pixel_type = *work.pixel_type;
    Part part{file_of_map(work.output, file.map), nullptr, first, file.channels};
    const bool scaled = file.low != 0 || file.high != 1;
    if (scaled && has_integers(part.file, encoding.pixel_type)) {
      tiled.notes.push_back(fmt::format("{}: 0 stands for {:g} and 1 for {:g}",
                                        part.file.filename().string(), file.low, file.high));
    } else if (scaled) {
      part.low = file.low;
      part.high = file.high;
    }
    Metadata own = metadata;
    if (file.kind == MapKind::normal) {
      own.merge(green_metadata(file.green));
      tiled.notes.push_back(
          fmt::format("{}: green points {}", part.file.filename().string(), to_word(file.green)));
    }
    part.rows = open_image_rows(part.file, work.size, file.channels, encoding, own);
    first += file.channels;
    tiled.files.push_back(part.file);
    parts.push_back(std::move(part));
  }
  return parts;
}

void write_rows(std::vector<Part>& parts, const std::vector<float>& pixels, int channels,
                int count) {
  const std::size_t all = static_cast<std::size_t>(channels);
  const std::size_t width = pixels.size() / all;
  if (parts.size() == 1 && parts[0].low == 0 && parts[0].high == 1)
    return parts[0].rows->write(pixels.data(), count);
  std::vector<float> own;
  for (Part& part : parts) {
    own.clear();
    for (std::size_t i = 0; i < width; ++i)
      for (int c = 0; c < part.channels; ++c)
        own.push_back(part.low + pixels[i * all + static_cast<std::size_t>(part.first + c)] *
                                     (part.high - part.low));
    part.rows->write(own.data(), count);
  }
}

// While one part of the rows is encoded, the next is made.
void make_rows(const TileWork& work, const StochasticTiling& tiling, std::vector<Part>& parts,
               const Control& control) {
  constexpr int rows_at_once = 64;
  std::future<void> encoding;
  const auto row_values =
      static_cast<std::size_t>(work.size.width) * static_cast<std::size_t>(tiling.channels());
  for (int y = 0; y < work.size.height; y += rows_at_once) {
    control.step(y, work.size.height);
    const int count = std::min(rows_at_once, work.size.height - y);
    std::vector<float> pixels(row_values * static_cast<std::size_t>(count));
    tiling.rows(y, count, work.size.width, pixels.data());
    if (encoding.valid()) encoding.get();
    encoding = std::async([&parts, &tiling, count, made = std::move(pixels)] {
      write_rows(parts, made, tiling.channels(), count);
    });
  }
  encoding.get();
  control.step(work.size.height, work.size.height);
}

}  // namespace

TiledFiles tile_picture(const TileWork& work, const Control& control) {
  Config config;
  config.exemplars.emplace_back();
  ExemplarEntry& entry = config.exemplars.front();
  entry.image = work.picture;
  entry.maps = work.maps;
  entry.max_side = work.max_side;
  entry.place = "tile";
  TiledFiles tiled;
  const LoadedRequest exemplar = load_request(config, 0);
  tiled.notes = exemplar.notes;
  const auto usable = [&](auto&& work_on) {
    try {
      return work_on();
    } catch (const ConfigError&) {
      throw;
    } catch (const Error& error) {
      throw ConfigError("tile {}: {}", work.picture.string(), error.what());
    }
  };
  const StochasticTiling tiling = usable([&] {
    check_files(work);
    check_fields(work.params);
    check_size(work.size);
    check_picture(exemplar.exemplars.front().image);
    return StochasticTiling(exemplar.exemplars.front(), work.params, work.size, work.tile,
                            Random(work.seed));
  });
  auto parts = usable([&] { return open_parts(work, exemplar, tiled); });
  make_rows(work, tiling, parts, control);
  for (Part& part : parts)
    for (const std::string& note : part.rows->finish())
      tiled.notes.push_back(fmt::format("{}: {}", part.file.filename().string(), note));
  return tiled;
}

}  // namespace gramloom
