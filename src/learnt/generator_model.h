#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/map_words.h"
#include "core/request.h"
#include "io/json_fields.h"
#include "io/safetensors.h"

namespace gramloom {

/// A level of a generator: what it adds to the picture of the coarser level, made twice as large.
/// `layers` convolutions of 3×3 with `hidden` channels see that picture and `noise` channels of
/// noise; the first level sees noise alone.
struct GeneratorLevel {
  int noise = 4;
  int hidden = 16;
  int layers = 3;

  static constexpr auto fields() {
    using L = GeneratorLevel;
    return std::tuple{Field{"noise", &L::noise, "channels of noise", "", {4, 32}},
                      Field{"hidden", &L::hidden, "channels of each convolution", "", {4, 128}},
                      Field{"layers", &L::layers, "convolutions", "", {1, 16}}};
  }
  friend bool operator==(const GeneratorLevel&, const GeneratorLevel&) = default;
};

/// What a generator has learnt from: an exemplar.
struct GeneratorMaterial {
  std::string name;
  std::string hash;     // of the exemplar's files (core/hash.h)
  std::string licence;  // what its owner says of it, "" where nothing is known

  static constexpr auto fields() {
    using M = GeneratorMaterial;
    return std::tuple{Field{"name", &M::name, "of the exemplar"},
                      Field{"hash", &M::hash, "of its files"},
                      Field{"licence", &M::licence, "under which it may be used"}};
  }
};

/// Channels [first, first + count) of a generated picture, as core/request.h's Layer.
struct GeneratorLayer {
  std::string name;
  MapKind kind = MapKind::colour;
  int first = 0;
  int count = 0;
  GreenAxis green = GreenAxis::up;

  static constexpr auto fields() {
    using L = GeneratorLayer;
    return std::tuple{Field{"name", &L::name, "of the map; none: the picture itself"},
                      Field{"kind", &L::kind, "what its values mean"},
                      Field{"first", &L::first, "channel", "", {0, 64}},
                      Field{"count", &L::count, "of channels", "", {1, 64}},
                      Field{"green", &L::green, "where the green of normals points"}};
  }
};

/// Channels that go into one file: a picture or a map, with its alpha, which is a layer of the same
/// name.
struct GeneratorPart {
  std::string name;
  MapKind kind = MapKind::colour;
  int first = 0;
  int count = 0;
};
std::vector<GeneratorPart> parts_of(const std::vector<GeneratorLayer>& layers);

/// All that describes a generator but its numbers: the text "gramloom" in its file's metadata.
struct GeneratorDescription {
  static constexpr int version = 1;
  std::string kind = "generator";
  int channels = 3;
  std::vector<GeneratorLayer> layers;        // of the picture, as the exemplars had them
  std::vector<GeneratorLevel> levels;        // the coarsest first
  std::vector<GeneratorMaterial> materials;  // one, or those that it blends
  Json recipe = Json::object();              // how it was trained
  Json scores = Json::object();              // of the state that was kept

  static constexpr auto fields() {
    using D = GeneratorDescription;
    return std::tuple{Field{"kind", &D::kind, "of the model"},
                      Field{"channels", &D::channels, "of the picture", "", {1, 64}},
                      Field{"layers", &D::layers, "of the picture"},
                      Field{"levels", &D::levels, "the coarsest first"},
                      Field{"materials", &D::materials, "that it has learnt"},
                      Field{"recipe", &D::recipe, "how it was trained"},
                      Field{"scores", &D::scores, "of the state that was kept"}};
  }
};

/// A trained generator: a chain of small convolutional networks, coarse to fine, each of which
/// passes only a picture on (as in Shaham, Dekel, Michaeli 2019, "SinGAN", and in the multi-scale
/// networks of Ulyanov, Lebedev, Vedaldi, Lempitsky 2016, "Texture networks").
///
///   level 0     P₀ = N₀(Z₀)
///   level k     P_k = U + N_k(U, Z_k),  U = P_{k−1} twice as large, linearly
///   N(x)        h₁ = a(C₁ x),  h_{i+1} = (h_i + a(C_{i+1} h_i)) / √2,  N = O h_n
///   a           leaky ReLU of slope 0.2, after a scale and shift of each channel that depend on
///   the
///               materials' shares (Perez et al. 2018, "FiLM"), where there are several materials
///   picture     mean + axes · P, clamped to the exemplars' range
///   Z           uniform noise of variance 1 (learnt/noise.h)
///
/// `tensors`, by the names that LibTorch gives them:
///   levels.K.layers.I.weight (hidden, inputs, 3, 3)    levels.K.layers.I.bias (hidden)
///   levels.K.out.weight (channels, hidden, 1, 1)       levels.K.out.bias (channels)
///   of several materials:
///   levels.K.scales.I, levels.K.shifts.I (materials, hidden)   levels.K.out_shifts (materials,
///   channels)
///   colours.mean, colours.low, colours.high (channels)   colours.axes (channels, channels)
struct GeneratorModel {
  GeneratorDescription description;
  std::map<std::string, TensorData> tensors;

  const std::vector<float>& values(const std::string& tensor) const {
    return tensors.at(tensor).values;
  }
  int level_count() const { return static_cast<int>(description.levels.size()); }
  int material_count() const { return static_cast<int>(description.materials.size()); }
};

inline constexpr float leaky_slope = 0.2f;

/// Channels that the first convolution of a level sees.
int inputs_of(const GeneratorDescription& description, int level);

/// The shape of every tensor of such a model.
std::map<std::string, std::vector<std::int64_t>> tensor_shapes(
    const GeneratorDescription& description);

/// Multiplications that the networks do for each pixel of the finest level.
double multiplications_per_pixel(const GeneratorDescription& description);

/// Reads a .safetensors file. Throws Error in one line with the path for a file that is damaged, is
/// no generator or of a newer version, or whose tensors are missing, of another shape or not
/// finite.
GeneratorModel read_generator(const std::filesystem::path& file);
/// Its description alone.
GeneratorDescription read_generator_description(const std::filesystem::path& file);

/// Complete or not at all; `more`: further texts of its metadata. Throws Error.
void write_generator(const std::filesystem::path& file, const GeneratorModel& model,
                     const std::map<std::string, std::string>& more = {});

}  // namespace gramloom
