#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "core/error.h"
#include "core/threads.h"
#include "jobs/methods.h"

namespace gramloom {

/// Variants of a method that take paths of their own are listed beside its defaults.
struct CausalMarkov : MarkovParams {
  static constexpr std::string_view kind = "markov_causal";
  CausalMarkov() { neighbourhood = MarkovNeighbourhood::causal; }
};

template <class List, class... More>
struct AlternativesOf;
template <class... Params, class... More>
struct AlternativesOf<std::variant<Params...>, More...> {
  using type = testing::Types<Params..., More...>;
};
/// From the list that the program itself has: a method added there is held to all of it.
using EveryMethod = AlternativesOf<Method, CausalMarkov>::type;

struct KindNames {
  template <class Params>
  static std::string GetName(int) {
    return std::string(Params::kind);
  }
};

/// Smooth grain with some correlation between its channels.
inline Image grain(Size size, int channels) {
  Image image(size, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) {
        const double u = x, v = y;
        const double waves = std::sin(0.61 * u + 1.3 * std::sin(0.37 * v)) +
                             std::sin(0.53 * v + 1.1 * std::sin(0.29 * u) + 0.4 * c) +
                             0.5 * std::sin(0.9 * u - 0.7 * v + c);
        image.at(x, y)[c] = static_cast<float>(0.5 + 0.15 * waves);
      }
  return image;
}

/// A test of one method, with settings that are quick enough for tests.
template <class Params>
class OfMethod : public testing::Test {
 protected:
  static constexpr bool takes_exemplar = Params::abilities.has(Ability::exemplar);
  static constexpr bool copies = Params::abilities.has(Ability::source);
  static constexpr bool is_neural = std::is_base_of_v<NeuralParams, Params>;

  void TearDown() override { set_thread_count(0); }

  static Params quick() {
    Params params;
    if constexpr (is_neural) {
      params.iterations = {4, 8};
      params.directions = 8;
    }
    return params;
  }

  /// Without the exemplar for a method that takes none.
  static Request request(const Image& exemplar, Target target, std::uint64_t seed = 1) {
    Request result{{}, std::move(target), Random(seed)};
    if (takes_exemplar) result.exemplars.push_back({exemplar});
    return result;
  }

  static Image make(const Image& exemplar, Size size, std::uint64_t seed = 1,
                    Tile tile = Tile::none) {
    return synthesise(quick(), request(exemplar, {size, tile}, seed), {}).image;
  }

  /// Of that size, and in the exemplar's channels and range or, without one, colours in [0, 1].
  static void expect_sound(const Image& image, const Image& exemplar, Size size) {
    ASSERT_EQ(image.size(), size);
    ASSERT_EQ(image.channels, takes_exemplar ? exemplar.channels : 3);
    const ChannelRange range =
        takes_exemplar ? channel_range(exemplar) : ChannelRange{{0, 0, 0}, {1, 1, 1}};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const std::size_t c = i % static_cast<std::size_t>(image.channels);
      ASSERT_TRUE(std::isfinite(image.pixels[i]));
      ASSERT_GE(image.pixels[i], range.low[c]);
      ASSERT_LE(image.pixels[i], range.high[c]);
    }
  }
};

}  // namespace gramloom
