#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "io/field_values.h"
#include "io/image_file.h"
#include "jobs/direction.h"
#include "jobs/map_file.h"
#include "jobs/methods.h"
#include "jobs/preview_entries.h"
#include "jobs/recipes.h"
#include "runs/baseline_limits.h"
#include "surface/maps.h"

namespace gramloom {

/// The file types of results; `automatic`: png for 8 and 16 bits, exr for floats, tif where there
/// are more channels than those two are used for.
enum class FileFormat { automatic, png, tif, exr, jpg };
template <>
inline constexpr auto enum_names<FileFormat> =
    std::to_array<std::string_view>({"automatic", "png", "tif", "exr", "jpg"});

/// A picture of a material, with what belongs to it.
struct ExemplarPicture {
  std::filesystem::path image;
  NamedFiles<MapFile>
      maps;  // further pictures of the same surface, pixel for pixel: "height", "roughness"
  FileOrName mask;
  std::filesystem::path guide;

  static constexpr auto fields() {
    using E = ExemplarPicture;
    return std::tuple{
        Field{"image", &E::image, "the picture"},
        Field{"maps", &E::maps, "maps of the same surface, made together with the picture"},
        Field{"mask", &E::mask,
              "a picture of its size: what is black is never used; or alpha: what is transparent"},
        Field{"guide", &E::guide, "a picture of its size: where it belongs, see [guide]"},
    };
  }
};

/// What textures are made from: an [[exemplar]] of the config. One with a `folder` stands for all
/// pictures in it (exemplar_folder.h): as many entries, called like their files. One with `images`
/// is several pictures of one material.
struct ExemplarEntry : ExemplarPicture {
  std::string name;                   // fit for a folder's name
  std::vector<ExemplarPicture> more;  // of `images`, all after the first
  std::optional<int> max_side;
  std::string licence;     // under which it may be used: a model that learns it says so
  bool is_filled = false;  // the picture that [fill] fills, without what is to be made
  std::string place;       // where the config says so, for messages

  static constexpr auto fields() {
    using E = ExemplarEntry;
    return std::tuple_cat(
        ExemplarPicture::fields(),
        std::tuple{Field{"max_side",
                         &E::max_side,
                         "scale the longer side down to this",
                         "pixels",
                         {1, longest_side}},
                   Field{"licence", &E::licence, "under which it may be used, for models of it"}});
  }
};

/// All pictures of an exemplar.
std::vector<ExemplarPicture> pictures_of(const ExemplarEntry& exemplar);

/// A method with its parameters: a [[method]] of the config.
struct MethodEntry {
  std::string name;  // fit for a folder's name
  Method method;
  std::string place;
};

/// A model to train: a [[model]] of the config.
struct ModelEntry {
  std::string name;
  ModelRecipe recipe;
  std::string place;
};

/// A config file. Every exemplar × every method × every seed is one job; a method that needs no
/// exemplar has one job a seed.
struct Config {
  std::filesystem::path file;
  std::string text;                    // as it stands on disk
  std::vector<std::string> overrides;  // the "key=value" of --set

  std::vector<int> seeds{1};
  Size size{256, 256};
  Tile tile = Tile::none;
  FileFormat format = FileFormat::automatic;
  std::optional<PixelType> pixel_type;  // none: the exemplar's
  bool scores = true;
  bool coordinates = false;
  std::vector<ExemplarEntry> exemplars;
  std::vector<MethodEntry> methods;
  std::vector<ModelEntry> models;      // that `gramloom train` trains
  Direction direction;                 // its [guide], [mix], [turn] and [fill]
  BaselineLimits baseline;             // its [baseline]
  SurfaceParams surface;               // its [surface]: maps of every result that has a height
  std::vector<PreviewEntry> previews;  // its [preview] or [[preview]]: pictures of results

  static constexpr auto fields() {
    using C = Config;
    return std::tuple{
        Field{"seeds", &C::seeds, "one job for each", "", {0, 2147483647}},
        Field{"size", &C::size, "width and height of the results", "pixels", {1, longest_side}},
        Field{"tile", &C::tile, "which edges must meet seamlessly"},
        Field{"format", &C::format, "file type of the results"},
        Field{"pixel_type", &C::pixel_type, "how results store a value; the exemplar's if not set"},
        Field{"scores", &C::scores, "score each texture against its exemplar"},
        Field{"coordinates", &C::coordinates,
              "write where each pixel was copied from, for methods that copy"},
    };
  }
};

/// The folder that the jobs of methods without an exemplar share; no exemplar can have its name
/// in a config with such a method.
inline constexpr std::string_view procedural_folder = "procedural";

/// Reads a config file and checks all that can be known without reading a picture (but for the size
/// of one that the texture's follows from); `overrides` are
/// "key=value" (a top-level key, or a parameter of every method that has it),
/// "method.NAME.key=value", "exemplar.NAME.key=value" or "SECTION.key=value", such as
/// "fill.mask=hole.png"; "preview.key=value" is of all previews, "preview.NAME.key=value" of one.
/// Throws ConfigError, which says where the mistake is.
Config read_config(const std::filesystem::path& file,
                   const std::vector<std::string>& overrides = {});

/// The same for a text; `file` gives its name in errors and the folder of its paths.
Config parse_config(const std::string& text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides = {});

}  // namespace gramloom
