#include "learnt/generator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/modules.h"
#include "io/image_file.h"
#include "io/models_folder.h"
#include "io/without_alpha.h"
#include "learnt/learnt_module.h"

namespace gramloom {

namespace {

// Shares of materials, 1 in all; weights that are all 0 have none.
bool normalise(float* shares, int count) {
  const float sum = std::accumulate(shares, shares + count, 0.0f);
  if (!(sum > 0)) return false;
  for (int m = 0; m < count; ++m) shares[m] /= sum;
  return true;
}

std::vector<float> shares_of(const GeneratorParams& params, int materials) {
  std::vector<float> shares(static_cast<std::size_t>(materials), 0.0f);
  if (params.weights.empty()) {
    shares[0] = 1;
    return shares;
  }
  if (static_cast<int>(params.weights.size()) != materials)
    throw ConfigError("weights: {} numbers are given, the model has {} materials",
                      params.weights.size(), materials);
  std::transform(params.weights.begin(), params.weights.end(), shares.begin(),
                 [](double weight) { return static_cast<float>(weight); });
  if (!normalise(shares.data(), materials)) throw ConfigError("weights: all are 0");
  return shares;
}

bool is_grey(const Image& picture) {
  if (picture.channels != 3) return false;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3)
    if (picture.pixels[i] != picture.pixels[i + 1] || picture.pixels[i] != picture.pixels[i + 2])
      return false;
  return true;
}

// As painting programs save it: with coverage, unless that is what the last material's channel is.
Image read_weights(const std::filesystem::path& file, int materials) {
  ImageFile read = read_image(file);
  const bool of_materials = read.image.channels == materials && materials > 2;  // two share a grey
  return of_materials ? std::move(read.image) : without_alpha(std::move(read));
}

// A channel a material, 1 in all, of a picture.
Image share_map_of(const GeneratorParams& params, int materials) {
  if (!params.weights.empty()) throw ConfigError("weights and weight_picture exclude each other");
  const Image picture = read_weights(params.weight_picture, materials);
  const bool between = materials == 2 && (picture.channels == 1 || is_grey(picture));
  if (!between && (picture.channels != materials || materials == 2))
    throw ConfigError(
        "weight_picture {}: has {} channels and the model {} materials: needed is a grey picture "
        "for two, else a channel a material",
        params.weight_picture.string(), picture.channels, materials);
  Image shares(picture.size(), materials);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const float* from = picture.at(x, y);
      float* to = shares.at(x, y);
      if (between) {
        to[1] = std::clamp(from[0], 0.0f, 1.0f);
        to[0] = 1 - to[1];
        continue;
      }
      for (int m = 0; m < materials; ++m) to[m] = std::max(0.0f, from[m]);
      if (!normalise(to, materials))
        throw ConfigError("weight_picture {}: all channels are 0 at ({}, {})",
                          params.weight_picture.string(), x, y);
    }
  return shares;
}

}  // namespace

std::filesystem::path model_file(const GeneratorParams& params) {
  return find_model(params.model, ".safetensors", "model");
}

Generation generation_of(const GeneratorParams& params, const GeneratorDescription& description,
                         Size size, Tile tile, const Random& random) {
  const int materials = static_cast<int>(description.materials.size());
  Generation wanted{size, tile, static_cast<std::uint32_t>(random.seed()), {}, {}};
  if (params.weight_picture.empty())
    wanted.shares = shares_of(params, materials);
  else
    wanted.share_map = share_map_of(params, materials);
  return wanted;
}

void generate(const GeneratorModel& model, const Generation& wanted, const WriteRows& write,
              const Control& control) {
  open_module<LearntModule>().generate(model, wanted, write, control);
}

Image generate(const GeneratorModel& model, const Generation& wanted, const Control& control) {
  Image image(wanted.size, model.description.channels);
  float* to = image.pixels.data();
  const auto row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  generate(
      model, wanted,
      [&](const float* rows, int count) {
        to = std::copy(rows, rows + row * static_cast<std::size_t>(count), to);
      },
      control);
  return image;
}

Texture split_generated(const Image& joined, const GeneratorDescription& description) {
  Texture texture;
  for (const GeneratorPart& part : parts_of(description.layers)) {
    Image& image = part.name.empty() ? texture.image : texture.maps[part.name];
    image = extract_channels(joined, part.first, part.count);
  }
  return texture;
}

Texture synthesise(const GeneratorParams& params, const Request& request, const Control& control) {
  check_fields(params);
  check_request<GeneratorParams>(request);
  const GeneratorModel model = read_generator(model_file(params));
  const Generation wanted = generation_of(params, model.description, request.target.size,
                                          request.target.tile, request.random);
  control.step(0, 1);
  return split_generated(generate(model, wanted, control), model.description);
}

Cost estimate_rows(const GeneratorDescription& description, Size size) {
  const double pixels = 1.0 * size.width * size.height;
  const double strip = 4.0 * size.width * 256 * description.channels;
  return {6e7 + strip,
          {.serial = 0.1,
           .shared = pixels * 5e-8,
           .operations = 2 * pixels * multiplications_per_pixel(description)}};
}

Cost estimate(const GeneratorParams& params, const RequestSize& request) {
  check_fields(params);
  check_request<GeneratorParams>(request);
  GeneratorDescription description;
  try {
    description = read_generator_description(model_file(params));
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
  generation_of(params, description, request.size, request.tile, Random(1));
  Cost cost = estimate_rows(description, request.size);
  cost.bytes += 8.0 * request.size.width * request.size.height * description.channels;
  return cost;
}

}  // namespace gramloom
