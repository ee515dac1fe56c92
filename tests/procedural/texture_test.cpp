#include "procedural/texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "core/threads.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Calls f(texture) for every texture there is, with its defaults.
template <class F, std::size_t... I>
void for_each_of(const F& f, std::index_sequence<I...>) {
  (f(std::variant_alternative_t<I, ProceduralTexture>{}), ...);
}
template <class F>
void for_each_texture(const F& f) {
  for_each_of(f, std::make_index_sequence<std::variant_size_v<ProceduralTexture>>{});
}

ProceduralParams params_of(ProceduralTexture texture) {
  ProceduralParams params;
  params.texture = std::move(texture);
  params.samples = 2;
  return params;
}

float difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::abs(static_cast<double>(a.pixels[i] - b.pixels[i]));
  return static_cast<float>(sum / static_cast<double>(a.pixels.size()));
}

/// Puts the number of threads back at the end of a test.
struct Threads {
  explicit Threads(int count) { set_thread_count(count); }
  ~Threads() { set_thread_count(0); }
};

TEST(Texture, NamesAreUniqueAndDefaultsAreInRange) {
  std::vector<std::string> names;
  check_fields(ProceduralParams{});
  for_each_texture([&](const auto& texture) {
    names.emplace_back(texture.name);
    EXPECT_FALSE(texture.summary.empty());
    EXPECT_NO_THROW(check_fields(texture)) << texture.name;
    using T = std::decay_t<decltype(texture)>;
    for_each_field<T>([&](const auto& field) {
      for_each_field<ProceduralParams>(
          [&](const auto& common) { EXPECT_NE(field.name, common.name) << texture.name; });
    });
  });
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(Texture, EveryTextureHasTheSizeTheRangeAndTheSameBytesForAnyThreads) {
  for_each_texture([](const auto& texture) {
    for (const Size size : {Size{1, 1}, Size{7, 5}, Size{16, 9}, Size{33, 65}})
      for (const Tile tile : {Tile::none, Tile::x, Tile::both}) {
        const auto run = [&](int threads) {
          const Threads with(threads);
          return synthesise(params_of(texture), {{}, {size, tile}, Random(5)}, {});
        };
        const Texture one = run(1), three = run(3);
        EXPECT_EQ(one.image, three.image) << texture.name;
        EXPECT_EQ(one.maps, three.maps) << texture.name;
        EXPECT_EQ(one.image.size(), size);
        EXPECT_EQ(one.image.channels, 3);
        for (const float v : one.image.pixels)
          ASSERT_TRUE(v >= 0 && v <= 1) << texture.name << " " << v;
        for (const auto& [name, map] : one.maps) {
          EXPECT_EQ(map.size(), size) << texture.name << " " << name;
          EXPECT_EQ(map.channels, 1);
          for (const float v : map.pixels)
            ASSERT_TRUE(v >= 0 && v <= 1) << texture.name << " " << name;
        }
      }
  });
}

TEST(Texture, EveryTextureHasSomethingToSeeAndMaterialsDependOnTheSeed) {
  for_each_texture([](const auto& texture) {
    const auto at = [&](std::uint64_t seed) {
      return synthesise(params_of(texture), {{}, {{64, 64}, Tile::none}, Random(seed)}, {}).image;
    };
    const Image a = at(1);
    EXPECT_GT(difference(a, Image(64, 64, 3, a.pixels[0])), 0.01f) << texture.name;
    using T = std::decay_t<decltype(texture)>;
    if constexpr (!std::is_same_v<T, Stripes> && !std::is_same_v<T, Checkerboard> &&
                  !std::is_same_v<T, Dots>) {
      EXPECT_NE(a, at(2)) << texture.name;
    }
  });
}

Canvas tiling_canvas(Size size, float scale, const Control& control) {
  Canvas canvas;
  canvas.size = size;
  canvas.tile = Tile::both;
  canvas.step_x = canvas.step_y = scale / static_cast<float>(std::min(size.width, size.height));
  canvas.width = static_cast<float>(size.width) * canvas.step_x;
  canvas.height = static_cast<float>(size.height) * canvas.step_y;
  canvas.origin = {0, 0, 0.381966f, 0.381966f};
  canvas.light = {0.5f, -0.5f, 0.70710678f};
  canvas.random = Random(3);
  canvas.control = &control;
  return canvas;
}

TEST(Texture, EveryTextureRepeatsWhereThePictureTiles) {
  const Control control;
  for_each_texture([&](const auto& texture) {
    const std::pair<Size, float> cases[] = {{{64, 32}, 8.0f}, {{90, 77}, 5.3f}, {{40, 61}, 3.0f}};
    for (const auto& [size, scale] : cases) {
      Canvas canvas = tiling_canvas(size, scale, control);
      const Texture here = paint(texture, canvas);
      canvas.origin[0] += canvas.width;
      canvas.origin[1] -= canvas.height;
      const Texture there = paint(texture, canvas);
      // Rounding of the larger coordinates aside; an edge may fall on the other side of a sample.
      EXPECT_LT(difference(here.image, there.image), 5e-4f) << texture.name << " " << scale;
      for (const auto& [name, map] : here.maps)
        EXPECT_LT(difference(map, there.maps.at(name)), 5e-4f) << texture.name << " " << name;
    }
  });
}

TEST(Texture, CheckerboardAndStripesAreTheirFormulas) {
  ProceduralParams params = params_of(Checkerboard{.first = {1, 1, 1}, .second = {0, 0, 0}});
  params.samples = 1;
  const Image board = synthesise(params, {{}, {{64, 64}, Tile::none}, Random(1)}, {}).image;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) EXPECT_EQ(*board.at(x, y), (x / 8 + y / 8) % 2 == 0 ? 1.0f : 0.0f);
  params.depth = 1;  // the next layer of cubes
  const Image below = synthesise(params, {{}, {{64, 64}, Tile::none}, Random(1)}, {}).image;
  EXPECT_EQ(*below.at(3, 3), 0);

  params = params_of(Stripes{.first = {1, 1, 1}, .second = {0, 0, 0}});
  const Image stripes = synthesise(params, {{}, {{64, 64}, Tile::none}, Random(1)}, {}).image;
  for (int x = 0; x < 64; ++x)  // a feature is two stripes; sign(sin(πx/w)) with w half of it
    EXPECT_EQ(*stripes.at(x, 9), std::sin(3.14159265 * (x + 0.5) / 4) > 0 ? 1.0f : 0.0f);
}

TEST(Texture, BrickAndTileAreTheirFormulas) {
  Brick brick;
  brick.aspect = 2;
  brick.mortar = 0.125;
  brick.wear = 0;
  ProceduralParams params = params_of(brick);
  params.scale = 2;
  const Image mortar =
      synthesise(params, {{}, {{128, 128}, Tile::both}, Random(1)}, {}).maps.at("mask");
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const double v = (y + 0.5) / 32, row = std::floor(v);
      const double u = (x + 0.5) / 64 + (static_cast<int>(row) % 2 == 1 ? 0.5 : 0);
      const double from_joint =
          std::min(0.5 - std::abs(u - std::floor(u) - 0.5), 0.5 * (0.5 - std::abs(v - row - 0.5)));
      if (std::abs(from_joint - 0.0625) < 0.02) continue;  // soft edges and rounded corners
      EXPECT_EQ(*mortar.at(x, y), from_joint < 0.0625 ? 1.0f : 0.0f) << x << " " << y;
    }

  Tiles tiles;
  tiles.grout = 0.25;
  params = params_of(tiles);
  params.scale = 4;
  const Image grout =
      synthesise(params, {{}, {{128, 96}, Tile::none}, Random(1)}, {}).maps.at("mask");
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 128; ++x) {
      const double u = (x + 0.5) / 24, v = (y + 0.5) / 24;
      const double from_joint =
          0.5 - std::max(std::abs(u - std::floor(u) - 0.5), std::abs(v - std::floor(v) - 0.5));
      if (std::abs(from_joint - 0.125) < 0.045) continue;
      EXPECT_EQ(*grout.at(x, y), from_joint < 0.125 ? 1.0f : 0.0f) << x << " " << y;
    }
}

TEST(Texture, EdgesAreSmoothWithOneSampleAndClearWithMany) {
  ProceduralParams params = params_of(Dots{});
  params.samples = 1;
  const Image one = synthesise(params, {{}, {{96, 96}, Tile::both}, Random(1)}, {}).maps.at("mask");
  params.samples = 16;
  const Image many =
      synthesise(params, {{}, {{96, 96}, Tile::both}, Random(1)}, {}).maps.at("mask");
  int between = 0;
  for (const float v : one.pixels) between += v > 0.05f && v < 0.95f;
  EXPECT_GT(between, 1000);
  EXPECT_LT(difference(one, many), 0.01f);
}

TEST(Texture, APlaneCutsTheSolid) {
  // Turned by 90° the picture's x axis is the solid's depth: the middle column is where both meet.
  ProceduralParams params = params_of(Marble{});
  params.samples = 1;
  const Image front = synthesise(params, {{}, {{33, 33}, Tile::none}, Random(1)}, {}).image;
  params.turn = 90;
  const Image side = synthesise(params, {{}, {{33, 33}, Tile::none}, Random(1)}, {}).image;
  for (int y = 0; y < 33; ++y) EXPECT_NEAR(*front.at(16, y), *side.at(16, y), 0.02);
  EXPECT_GT(difference(front, side), 0.02f);
}

TEST(Texture, FramesMoveThroughTheSolidAndALoopComesBack) {
  Noise noise;
  for (const int dimensions : {3, 4}) {
    noise.dimensions = dimensions;
    ProceduralParams params = params_of(noise);
    params.frames = 4;
    params.travel = 2;
    const Texture sequence = synthesise(params, {{}, {{32, 32}, Tile::both}, Random(1)}, {});
    ASSERT_EQ(sequence.maps.size(), 5u);  // and the height
    EXPECT_EQ(sequence.maps.at("frame_0001"), sequence.image);
    EXPECT_NE(sequence.maps.at("frame_0002"), sequence.image);
    if (dimensions == 3) {
      params.frames = 1;
      params.depth = 0.5;
      EXPECT_LT(difference(synthesise(params, {{}, {{32, 32}, Tile::both}, Random(1)}, {}).image,
                           sequence.maps.at("frame_0002")),
                1e-5f);
    }
    // A loop comes back to the plane that it began with.
    if (dimensions == 4) continue;
    params.frames = 1;
    params.loop = true;
    params.depth = 0;
    const Image begin = synthesise(params, {{}, {{32, 32}, Tile::both}, Random(1)}, {}).image;
    params.depth = params.travel;
    EXPECT_LT(
        difference(synthesise(params, {{}, {{32, 32}, Tile::both}, Random(1)}, {}).image, begin),
        1e-4f);
  }
}

TEST(Texture, WhatDoesNotFitIsAnError) {
  const Target target{{16, 16}, Tile::none};
  ProceduralParams params = params_of(Brick{});
  params.frames = 2;
  EXPECT_THAT(
      [&] {
        synthesise(params, {{}, target, Random(1)}, {});
      },
      ThrowsMessage<ConfigError>(HasSubstr("'brick' is flat")));
  params = params_of(Marble{});
  params.tilt = 10;
  EXPECT_THROW(synthesise(params, {{}, {{16, 16}, Tile::x}, Random(1)}, {}), ConfigError);
  Marble marble;
  marble.layers = {1, 2};
  params = params_of(marble);
  EXPECT_THAT(
      [&] {
        synthesise(params, {{}, target, Random(1)}, {});
      },
      ThrowsMessage<ConfigError>(HasSubstr("layers")));
  Noise noise;
  noise.octaves = 99;
  params = params_of(noise);
  EXPECT_THROW(synthesise(params, {{}, target, Random(1)}, {}), ConfigError);
  noise = Noise{};
  noise.colours = {1, 1, 1, 0};
  params = params_of(noise);
  EXPECT_THROW(synthesise(params, {{}, target, Random(1)}, {}), ConfigError);
  params = params_of(Noise{});
  params.scale = std::nan("");
  EXPECT_THROW(synthesise(params, {{}, target, Random(1)}, {}), ConfigError);
}

TEST(Texture, OctavesFinerThanAnySampleAreLeftOut) {
  Noise noise;
  noise.octaves = max_octaves;
  noise.lacunarity = 8;
  noise.gain = 1;
  for (noise.dimensions = 1; noise.dimensions <= 4; ++noise.dimensions) {
    const Image image =
        synthesise(params_of(noise), {{}, {{32, 32}, Tile::both}, Random(1)}, {}).image;
    const ChannelRange range = channel_range(image);
    EXPECT_GT(range.low[0], 0.05f);
    EXPECT_LT(range.high[0], 0.95f);
    EXPECT_GT(range.high[0] - range.low[0], 0.05f);
  }
}

TEST(Texture, StopsWhenAsked) {
  Control control;
  control.progress = [](const Progress&) { return false; };
  EXPECT_THROW(synthesise(params_of(Noise{}), {{}, {{16, 16}, Tile::none}, Random(1)}, control),
               Interrupted);
}

}  // namespace
}  // namespace gramloom
