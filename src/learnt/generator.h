#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"
#include "learnt/generator_model.h"

namespace gramloom {

/// A texture by a trained generator (learnt/generator_model.h): `gramloom train` makes these, and
/// some lie in models/. No exemplar is needed: the material is in the model. A config's exemplar,
/// where the method names one, is only what the results are scored against.
struct GeneratorParams {
  static constexpr std::string_view kind = "generator";
  static constexpr std::string_view summary =
      "a small network that was trained on a texture, or on several to blend: any size at once";
  static constexpr Abilities abilities{};
  FileOrName model = "pebbles";
  std::vector<double> weights;
  std::filesystem::path weight_picture;
  std::string exemplar;

  static constexpr auto fields() {
    using G = GeneratorParams;
    return std::tuple{
        Field{"model", &G::model,
              "a model's file (.safetensors), or the name of one in gramloom's models folder"},
        Field{"weights",
              &G::weights,
              "share of each material of the model; none: the first alone",
              "",
              {0, 1e6}},
        Field{
            "weight_picture", &G::weight_picture,
            "shares from place to place, stretched over the texture: a channel a material, or one "
            "channel from the first (black) of two to the second"},
        Field{"exemplar", &G::exemplar,
              "name of the config's exemplar that the textures are scored against"},
    };
  }
};

/// The file of its model. Throws ConfigError for a name that no model has.
std::filesystem::path model_file(const GeneratorParams& params);

/// A texture of a generator, to be made.
struct Generation {
  Size size;
  Tile tile = Tile::none;
  std::uint32_t seed = 1;
  std::vector<float> shares;  // of each material, 1 in all
  Image share_map;            // a channel a material, 1 in all; of any size; empty: `shares`
};

/// What the parameters ask of that model. Throws ConfigError for weights that don't fit it.
Generation generation_of(const GeneratorParams& params, const GeneratorDescription& description,
                         Size size, Tile tile, const Random& random);

/// Makes it by rows of tiles, and hands each on as it is done: `write(rows, count)`, interleaved,
/// in memory that does not grow with the height. The same bytes for any number of threads.
/// Throws Interrupted.
using WriteRows = std::function<void(const float* rows, int count)>;
void generate(const GeneratorModel& model, const Generation& wanted, const WriteRows& write,
              const Control& control);
/// The whole, channels as the model's layers.
Image generate(const GeneratorModel& model, const Generation& wanted, const Control& control);

/// The texture, its picture and its maps. Throws ConfigError for parameters that the model refuses,
/// Error for a model that cannot be read.
Texture synthesise(const GeneratorParams& params, const Request& request, const Control& control);
Cost estimate(const GeneratorParams& params, const RequestSize& request);

/// What making a picture of this size by rows is expected to need.
Cost estimate_rows(const GeneratorDescription& description, Size size);

/// The channels of a generated picture as a texture: the first layer its image, others its maps.
Texture split_generated(const Image& joined, const GeneratorDescription& description);

}  // namespace gramloom
