#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "io/field_values.h"
#include "jobs/map_file.h"

namespace gramloom {

/// What a guide's values are.
enum class GuideKind {
  automatic,  // labels where all guides together have at most 32 colours, else values
  labels,     // each colour is a label of its own: what has it goes where the target has it, only
  values      // the nearer two values are, the likelier one goes where the other is
};
template <>
inline constexpr auto enum_names<GuideKind> = std::to_array<std::string_view>({"automatic",
                                                                               "labels", "values"});

/// [guide]: what goes where. Exemplars have guides of their own (ExemplarPicture::guide).
struct GuideEntry {
  static constexpr std::string_view section = "guide";
  std::filesystem::path image;
  GuideKind kind = GuideKind::automatic;
  double weight = 1;
  std::filesystem::path weight_image;

  static constexpr auto fields() {
    using G = GuideEntry;
    return std::tuple{
        Field{"image", &G::image, "the guide of the texture: its size is the texture's"},
        Field{"kind", &G::kind, "what the values of guides are"},
        Field{"weight",
              &G::weight,
              "how much the guide counts beside the picture; labels count ten times as much",
              "",
              {0, 1000}},
        Field{"weight_image", &G::weight_image,
              "a picture of that from place to place: white is `weight`, black 0"},
    };
  }
};

/// [mix]: how much of each picture of the material (ExemplarEntry::images) goes in.
struct MixEntry {
  static constexpr std::string_view section = "mix";
  std::vector<double> weights;
  std::vector<std::filesystem::path> images;

  static constexpr auto fields() {
    using M = MixEntry;
    return std::tuple{
        Field{"weights", &M::weights, "one for each picture of the exemplar", "", {0, 1e6}},
        Field{"images", &M::images,
              "pictures of that from place to place, as large as the texture, one for each picture "
              "of the exemplar; or one for two: black is the first, white the second"},
    };
  }
};

/// [turn]: how the exemplar is laid from place to place.
struct TurnEntry {
  static constexpr std::string_view section = "turn";
  std::filesystem::path angle;
  std::vector<double> angles{0, 360};
  std::filesystem::path scale;
  std::vector<double> scales{0.5, 2};

  static constexpr auto fields() {
    using T = TurnEntry;
    return std::tuple{
        Field{"angle", &T::angle, "a picture, as large as the texture: how far it is turned"},
        Field{"angles",
              &T::angles,
              "what black and white stand for, counter-clockwise",
              "degrees",
              {-3600, 3600}},
        Field{"scale", &T::scale, "a picture, as large as the texture: how large it is"},
        Field{"scales",
              &T::scales,
              "what black and white stand for; grey is between in proportion",
              "times",
              {0.125, 8}},
    };
  }
};

/// [fill]: a picture of which a part is made anew. The results have its size and its pixel type.
struct FillEntry {
  static constexpr std::string_view section = "fill";
  std::filesystem::path image;
  NamedFiles<MapFile> maps;
  FileOrName mask;
  Tile seamless = Tile::none;
  int band = 0;
  std::vector<int> extend;
  int blend = 4;

  static constexpr auto fields() {
    using F = FillEntry;
    return std::tuple{
        Field{"image", &F::image, "the picture; what is not made anew stays byte for byte"},
        Field{"maps", &F::maps, "maps of the same surface, filled together with it"},
        Field{"mask", &F::mask,
              "a picture of its size: white is made anew; or alpha: where it is transparent"},
        Field{"seamless", &F::seamless, "make a band at the edges anew, so that these edges meet"},
        Field{"band",
              &F::band,
              "width of that band on each side; 0: an eighth of the picture, 64 at most",
              "pixels",
              {0, longest_side}},
        Field{"extend",
              &F::extend,
              "add to the picture on its left, top, right and bottom",
              "pixels",
              {0, longest_side}},
        Field{"blend",
              &F::blend,
              "how far from what stays the colours and heights that quilting, patchmatch and pixel "
              "copy are fitted to it; 0: they stay copies",
              "pixels",
              {0, 16}},
    };
  }
};

/// How a config directs its textures; what it does not have is left to chance.
struct Direction {
  std::optional<GuideEntry> guide;
  std::optional<MixEntry> mix;
  std::optional<TurnEntry> turn;
  std::optional<FillEntry> fill;
};

/// Calls f(entry) for each of those std::optional members.
template <class D, class F>
void for_each_direction(D&& direction, F&& f) {
  f(direction.guide);
  f(direction.mix);
  f(direction.turn);
  f(direction.fill);
}

}  // namespace gramloom
