#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// What the values of a layer mean, and so how they may be mixed, whitened, clamped and scored.
enum class MapKind {
  colour,  // channels that are seen together: mixed, whitened and scored as one
  scalar,  // each channel a quantity of its own: height, roughness
  normal,  // a direction in three channels, (1 + component) / 2 each: of unit length
  alpha    // coverage, 0 to 1
};

/// Where the green channel of a map of normals points: up the picture (OpenGL), or down (DirectX).
enum class GreenAxis { up, down };

/// Channels [first, first + count) of an exemplar's image.
struct Layer {
  std::string name;  // that of the map's file; "" for the picture itself
  MapKind kind = MapKind::colour;
  int first = 0;
  int count = 0;
  GreenAxis green = GreenAxis::up;  // of normals

  friend bool operator==(const Layer&, const Layer&) = default;
};

/// A picture of a texture and maps of the same surface, joined to one image, so that a method makes
/// them together and they stay registered.
/// Methods that copy whole pixels (Ability::source) keep the values of layers of every kind, unless
/// they are to go over into known ones (Target::blend). Others
/// mix no layers (see signal/layer_axes.h), but a normal whose channels they mix is no longer of
/// unit length: jobs make it so again (jobs/unit_normals.h).
struct Exemplar {
  Image image;
  std::vector<Layer> layers = {};  // each channel in one of them, in order; none: all are colour
  Image mask = {};   // one channel, the image's size: 1 may be used, 0 may not; empty: all may
  Image guide = {};  // the image's size, any channels: what is like this goes where the target's
                     // guide is alike; empty: anywhere
};

/// What is wanted: the texture's size, which of its edges meet, and what is known of it.
struct Target {
  Size size{256, 256};
  Tile tile = Tile::none;
  Image known = {};  // `size`, an exemplar's channels: what the texture has where `mask` is 0
  Image mask = {};   // `size`, one channel: 1 is made anew, 0 stays as known; empty: all is made
  Image guide = {};  // `size`, the channels of the exemplars' guides; empty: none
  /// How much being alike in the guide counts, beside being alike in the picture: one channel, 0 or
  /// more, of `size` or of 1×1, which is everywhere the same; empty: 1.
  Image guide_weight = {};
  /// How much of each exemplar is mixed in: a channel an exemplar, 0 or more and not all 0, of
  /// `size` or of 1×1; only their ratios count. Empty: the exemplars are one material together.
  Image weights = {};
  /// How the exemplar is laid: two channels, of `size` or of 1×1: turns counter-clockwise, and the
  /// logarithm to base 2 of how much larger. Empty: upright, as large as it is.
  Image turn = {};
  /// Over how many pixels what a method copies goes over into known pixels, in colours and scalars
  /// (signal/blended_joins.h); 0: its pixels are the exemplars' own. Methods that copy nothing make
  /// pixels that fit in any case.
  int blend = 0;
};

/// Everything that a method is ever asked. A method ignores nothing silently: what it cannot honour
/// it refuses by name (core/abilities.h).
///
///   const Request request{.exemplars = {{picture}},
///                         .target = {{512, 512}, Tile::both},
///                         .random = Random(seed)};
struct Request {
  std::vector<Exemplar> exemplars = {};  // the same layers in each; none for a method of formulas
  Target target = {};
  Random random = Random(1);  // the result depends on it and the rest of the request alone
};

/// A request without its pixels: all that its cost, and whether a method can honour it, depend on.
struct ExemplarSize {
  Size size;
  int channels = 0;
  bool mask = false;    // whether there is one
  bool guide = false;   // likewise
  bool filled = false;  // whether it is the picture that is filled
};
struct RequestSize {
  std::vector<ExemplarSize> exemplars = {};
  Size size{256, 256};
  Tile tile = Tile::none;
  bool known = false;  // known pixels, or a mask of what is to be made
  double made = 1;     // which part of the target's pixels is made
  /// Of what is made and its surroundings (core/surroundings.h): all that a fill need look at;
  /// empty where edges meet, or too little there may be used.
  Size around = {};
  bool guide = false;
  bool weights = false;  // of several exemplars
  bool turn = false;
};
RequestSize size_of(const Request& request);

/// The exemplar's pixel that a texture's pixel was copied from. Sides below 2²⁴ pixels.
struct Source {
  std::uint64_t x : 24;
  std::uint64_t y : 24;
  std::uint64_t exemplar : 16;  // index into Request::exemplars

  constexpr Source() : Source(0, 0) {}
  constexpr Source(int x_, int y_, int exemplar_ = 0)
      : x(static_cast<std::uint64_t>(x_) & 0xFFFFFF),
        y(static_cast<std::uint64_t>(y_) & 0xFFFFFF),
        exemplar(static_cast<std::uint64_t>(exemplar_) & 0xFFFF) {}

  friend bool operator==(const Source&, const Source&) = default;
};

/// A source for each pixel, row by row; empty where nothing was copied.
struct SourceMap {
  Size size;
  std::vector<Source> pixels;

  SourceMap() = default;
  explicit SourceMap(Size size_)
      : size(size_),
        pixels(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}

  bool empty() const { return pixels.empty(); }
  /// The source of pixel (x, y); those of its row follow.
  Source* at(int x, int y) { return pixels.data() + index(x, y); }
  const Source* at(int x, int y) const { return pixels.data() + index(x, y); }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }
};

/// The exemplars' pixels that `sources` names. Those lie within their exemplar.
Image arranged(const SourceMap& sources, const std::vector<Exemplar>& exemplars);

/// What a method returns.
struct Texture {
  Image image;
  /// Other maps of the same surface by name ("height", "mask", "frame_0001"), each written beside
  /// the image.
  std::map<std::string, Image> maps = {};
  /// Of methods that copy (Ability::source): where each pixel came from. arranged() makes the image
  /// of it again, exactly but for pixels that the method says it blends, and those that are blended
  /// into known ones (Target::blend).
  SourceMap source = {};
};

/// The texture that `source` makes of the exemplars.
Texture texture_of(SourceMap source, const std::vector<Exemplar>& exemplars);

}  // namespace gramloom
