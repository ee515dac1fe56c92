#include "learnt/generator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/threads.h"
#include "io/image_file.h"
#include "io/temp_folder.h"
#include "learnt/level_axis.h"
#include "learnt/noise.h"
#include "learnt/some_generator.h"

namespace gramloom {
namespace {

GeneratorModel model_of_three_levels(int materials = 1, int channels = 3) {
  return some_generator({{8, 16, 3}, {4, 24, 2}, {4, 8, 1}}, channels, materials);
}

Generation wanted(Size size, Tile tile = Tile::none, std::vector<float> shares = {1}) {
  return {size, tile, 5, std::move(shares), {}};
}

float largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.size(), b.size());
  float largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
  return largest;
}

// The part of `image` at (x, y), around its edges where it tiles.
Image part(const Image& image, int left, int top, Size size) {
  Image cut(size, image.channels);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      std::copy_n(image.at((left + x) % image.width, (top + y) % image.height), image.channels,
                  cut.at(x, y));
  return cut;
}

TEST(Generator, MakesAPictureThatVaries) {
  const Image image = generate(model_of_three_levels(), wanted({70, 50}), {});
  const ChannelRange range = channel_range(image);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_GT(range.high[c] - range.low[c], 0.05);
}

// The formula of the model's header, by plain loops, on a picture that tiles.
class ByHand {
 public:
  ByHand(const GeneratorModel& model, Size size, std::uint32_t seed)
      : model_(model), size_(size), seed_(seed) {}

  Image picture() const {
    const Image last = level(model_.level_count() - 1);
    Image image(last.size(), last.channels);
    for (std::size_t p = 0; p < image.pixels.size(); ++p) {
      const std::size_t c = p % static_cast<std::size_t>(image.channels), first = p - c;
      float sum = model_.values("colours.mean")[c];
      for (std::size_t i = 0; i < static_cast<std::size_t>(image.channels); ++i)
        sum += model_.values("colours.axes")[c * static_cast<std::size_t>(image.channels) + i] *
               last.pixels[first + i];
      image.pixels[p] =
          std::clamp(sum, model_.values("colours.low")[c], model_.values("colours.high")[c]);
    }
    return image;
  }

 private:
  static Image convolved(const Image& image, const TensorData& weight, const TensorData& bias) {
    const int outputs = static_cast<int>(weight.shape[0]), side = static_cast<int>(weight.shape[2]);
    Image result(image.size(), outputs);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int o = 0; o < outputs; ++o) {
          double sum = bias.values[static_cast<std::size_t>(o)];
          for (int c = 0; c < image.channels; ++c)
            for (int j = 0; j < side; ++j)
              for (int i = 0; i < side; ++i)
                sum += static_cast<double>(weight.values[static_cast<std::size_t>(
                           ((o * image.channels + c) * side + j) * side + i)]) *
                       static_cast<double>(
                           image.at((x + i - side / 2 + image.width) % image.width,
                                    (y + j - side / 2 + image.height) % image.height)[c]);
          result.at(x, y)[o] = static_cast<float>(sum);
        }
    return result;
  }

  Image level(int k) const {
    const GeneratorLevel& shape = model_.description.levels[static_cast<std::size_t>(k)];
    const int shift = model_.level_count() - 1 - k;
    const Size size{size_.width >> shift, size_.height >> shift};
    const int channels = k == 0 ? 0 : model_.description.channels;
    Image input(size, channels + shape.noise);
    const Image coarser = k == 0 ? Image() : level(k - 1);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        for (int c = 0; c < channels; ++c) input.at(x, y)[c] = doubled(coarser, x, y, c);
        for (int c = 0; c < shape.noise; ++c)
          input.at(x, y)[channels + c] = noise_value(
              pcg4d(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed_,
                    static_cast<std::uint32_t>(k * noise_groups_per_level +
                                               c / 4))[static_cast<std::size_t>(c % 4)]);
      }
    Image values = input;
    const std::string name = fmt::format("levels.{}.", k);
    for (int i = 0; i < shape.layers; ++i) {
      Image next = convolved(values, model_.tensors.at(fmt::format("{}layers.{}.weight", name, i)),
                             model_.tensors.at(fmt::format("{}layers.{}.bias", name, i)));
      for (std::size_t p = 0; p < next.pixels.size(); ++p) {
        float& v = next.pixels[p];
        v = v > 0 ? v : leaky_slope * v;
        if (i > 0) v = (values.pixels[p] + v) * std::sqrt(0.5f);
      }
      values = std::move(next);
    }
    Image added = convolved(values, model_.tensors.at(name + "out.weight"),
                            model_.tensors.at(name + "out.bias"));
    for (int y = 0; k > 0 && y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < channels; ++c) added.at(x, y)[c] += input.at(x, y)[c];
    return added;
  }

  // Between the centres of the coarser pixels, linearly.
  static float doubled(const Image& coarser, int x, int y, int channel) {
    const auto axis = [](int at, int length, int& below, int& above) {
      const double place = (at + 0.5) / 2 - 0.5;
      const double floor = std::floor(place);
      below = (static_cast<int>(floor) + length) % length;
      above = (below + 1) % length;
      return static_cast<float>(place - floor);
    };
    int x0, x1, y0, y1;
    const float right = axis(x, coarser.width, x0, x1), down = axis(y, coarser.height, y0, y1);
    const auto row = [&](int at) {
      return (1 - right) * coarser.at(x0, at)[channel] + right * coarser.at(x1, at)[channel];
    };
    return (1 - down) * row(y0) + down * row(y1);
  }

  const GeneratorModel& model_;
  Size size_;
  std::uint32_t seed_;
};

TEST(Generator, IsTheFormulaOfItsHeader) {
  const GeneratorModel model = model_of_three_levels();
  const Size size{48, 32};
  EXPECT_LT(largest_difference(generate(model, wanted(size, Tile::both), {}),
                               ByHand(model, size, 5).picture()),
            1e-5);
}

TEST(Generator, PartsAreThoseOfALargerPicture) {
  const GeneratorModel model = model_of_three_levels();
  const Image small = generate(model, wanted({150, 90}), {});
  const Image large = generate(model, wanted({450, 310}), {});
  EXPECT_LT(largest_difference(small, part(large, 0, 0, small.size())), 1e-5);
}

TEST(Generator, RowsAreThoseOfTheWhole) {
  const GeneratorModel model = model_of_three_levels(2, 4);
  Generation asked = wanted({230, 410}, Tile::y, {0.3f, 0.7f});
  const Image whole = generate(model, asked, {});
  std::vector<float> rows;
  int calls = 0;
  generate(model, asked,
           [&](const float* values, int count) {
             ++calls;
             rows.insert(rows.end(), values, values + 230 * 4 * count);
           },
           {});
  EXPECT_GT(calls, 1);
  EXPECT_EQ(rows, whole.pixels);
}

TEST(Generator, TilesOnEachAxisAtAnySize) {
  const GeneratorModel model = model_of_three_levels();
  for (const Size size : {Size{64, 64}, Size{61, 75}, Size{250, 203}}) {
    const Image image = generate(model, wanted(size, Tile::both), {});
    // A step across the edges is no larger than those inside.
    float inside = 0, across = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < 3; ++c) {
          const float step = std::abs(image.at(x, y)[c] - image.at((x + 1) % size.width, y)[c]);
          (x + 1 < size.width ? inside : across) =
              std::max(x + 1 < size.width ? inside : across, step);
        }
    EXPECT_LE(across, inside * 1.1f);
  }
}

TEST(Generator, SameBytesForAnyNumberOfThreads) {
  const GeneratorModel model = model_of_three_levels();
  set_thread_count(1);
  const Image one = generate(model, wanted({500, 300}), {});
  for (const int threads : {2, 3}) {
    set_thread_count(threads);
    EXPECT_EQ(generate(model, wanted({500, 300}), {}), one);
  }
  set_thread_count(0);
}

TEST(Generator, AConstantMapOfSharesIsThoseShares) {
  const GeneratorModel model = model_of_three_levels(3);
  const std::vector<float> shares{0.2f, 0.5f, 0.3f};
  Generation by_map = wanted({100, 60}, Tile::x, {});
  by_map.share_map = Image(7, 5, 3);
  for (std::size_t i = 0; i < by_map.share_map.pixels.size(); ++i)
    by_map.share_map.pixels[i] = shares[i % 3];
  EXPECT_LT(largest_difference(generate(model, by_map, {}),
                               generate(model, wanted({100, 60}, Tile::x, shares), {})),
            1e-4);
}

TEST(Generator, SeedsAreUnlike) {
  const GeneratorModel model = model_of_three_levels();
  Generation other = wanted({64, 64});
  other.seed = 6;
  EXPECT_GT(largest_difference(generate(model, wanted({64, 64}), {}), generate(model, other, {})),
            0.05);
}

TEST(Generator, MapsArePartedFromThePicture) {
  const GeneratorModel model = model_of_three_levels(1, 4);
  const Image joined = generate(model, wanted({40, 30}), {});
  const Texture texture = split_generated(joined, model.description);
  EXPECT_EQ(texture.image, extract_channels(joined, 0, 3));
  ASSERT_TRUE(texture.maps.contains("map3"));
  EXPECT_EQ(texture.maps.at("map3"), extract_channels(joined, 3, 1));
}

TEST(Generator, RefusesWeightsThatDoNotFit) {
  const GeneratorDescription two = model_of_three_levels(2).description;
  GeneratorParams params;
  const auto ask = [&] { generation_of(params, two, {16, 16}, Tile::none, Random(1)); };
  params.weights = {1, 2, 3};
  EXPECT_THAT(ask, testing::ThrowsMessage<ConfigError>(
                       testing::HasSubstr("3 numbers are given, the model has 2 materials")));
  params.weights = {0, 0};
  EXPECT_THAT(ask, testing::ThrowsMessage<ConfigError>(testing::HasSubstr("all are 0")));
}

class WeightPicture : public TempFolder {};

TEST_F(WeightPicture, MayHaveCoverageBesideItsWeights) {
  GeneratorParams params;
  params.weight_picture = path("w.png");
  const auto shares = [&](int materials, const std::vector<float>& pixel) {
    Image picture(1, 1, static_cast<int>(pixel.size()));
    picture.pixels = pixel;
    write_image(params.weight_picture, picture, {});
    return generation_of(params, model_of_three_levels(materials).description, {16, 16}, Tile::none,
                         Random(1))
        .share_map.pixels;
  };
  EXPECT_EQ(shares(2, {1, 0}), (std::vector<float>{0, 1}));           // grey, transparent
  EXPECT_EQ(shares(2, {1, 1, 1, 0}), (std::vector<float>{0, 1}));     // likewise in colours
  EXPECT_EQ(shares(3, {0, 1, 0, 1}), (std::vector<float>{0, 1, 0}));  // a channel a material
  EXPECT_EQ(shares(4, {0, 0, 0, 1}), (std::vector<float>{0, 0, 0, 1}));
}

TEST(LevelAxis, WhatWrapsIsTheSameToTheLastBit) {
  for (const int length : {64, 61, 7, 1}) {
    const auto axes = level_axes(length, true, 3);
    for (const LevelAxis& axis : axes) {
      const auto here = upsampling(axis, -3, static_cast<int>(axis.length));
      const auto there = upsampling(axis, -3 + axis.length, static_cast<int>(axis.length));
      EXPECT_EQ(here.weights, there.weights);
      for (std::size_t i = 0; i < here.from.size(); ++i)
        EXPECT_EQ(here.from[i] + axis.coarser, there.from[i]);
    }
  }
}

TEST(Noise, HasMeanZeroAndVarianceOne) {
  double sum = 0, square = 0;
  for (std::uint32_t y = 0; y < 100; ++y)
    for (std::uint32_t x = 0; x < 100; ++x)
      for (const std::uint32_t word : pcg4d(x, y, 1, 64)) {
        const float value = noise_value(word);
        sum += value;
        square += value * value;
      }
  EXPECT_NEAR(sum / 40000, 0, 0.02);
  EXPECT_NEAR(square / 40000, 1, 0.02);
}

}  // namespace
}  // namespace gramloom
