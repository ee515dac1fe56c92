// What goes in comes out, or a line says why not: number types, ranges, alpha, missing data.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "io/image_algorithms.h"
#include "io/image_file.h"
#include "io/temp_folder.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using ImageValues = TempFolder;

/// A TIFF of one row of numbers, little-endian. `kind`: 1 unsigned, 2 signed, 3 floating.
template <class T>
std::string tiff(const std::vector<T>& numbers, std::uint16_t kind) {
  std::string bytes("II\x2a\0\x08\0\0\0", 8);
  const auto number = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  struct Tag {
    std::uint16_t name, type;
    std::uint32_t value;
  };
  const auto width = static_cast<std::uint32_t>(numbers.size());
  const auto data = static_cast<std::uint32_t>(numbers.size() * sizeof(T));
  const std::vector<Tag> tags{{256, 3, width}, {257, 3, 1}, {258, 3, 8 * sizeof(T)},
                              {259, 3, 1},     {262, 3, 1}, {273, 4, 8 + 2 + 10 * 12 + 4},
                              {277, 3, 1},     {278, 3, 1}, {279, 4, data},
                              {339, 3, kind}};
  number(static_cast<std::uint16_t>(tags.size()));
  for (const Tag& tag : tags) {
    number(tag.name);
    number(tag.type);
    number(std::uint32_t{1});
    number(tag.value);
  }
  number(std::uint32_t{0});
  for (const T value : numbers) number(value);
  return bytes;
}

// Address space that this process may take beyond what it has, as long as one of these lives.
class MoreAtMost {
 public:
  explicit MoreAtMost(rlim_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlimit limit{pages * static_cast<rlim_t>(getpagesize()) + bytes, before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
  }
  ~MoreAtMost() { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{};
};

TEST_F(ImageValues, OfFewAndVeryLongRows) {
  constexpr int width = 1'000'001, channels = 3;
  std::string bytes = fmt::format("P6\n{} 2\n255\n", width);
  for (int i = 0; i < 2 * width * channels; ++i) bytes += static_cast<char>(i % 251);
  write_text(path("a.ppm"), bytes);
  read_image_size(path("a.ppm"));  // loads the readers
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const MoreAtMost limit(400 << 20);  // of 256 rows there would be twice as much
#endif
  const Image image = read_image(path("a.ppm")).image;
  ASSERT_EQ(image.size(), (Size{width, 2}));
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    ASSERT_EQ(image.pixels[i], static_cast<float>(i % 251) / 255.0f) << i;
}

TEST_F(ImageValues, NumbersOfOtherTypesComeAsTheyAre) {
  const auto read = [&](const std::string& bytes) {
    write_text(path("a.tif"), bytes);
    const ImageFile file = read_image(path("a.tif"));
    EXPECT_EQ(file.encoding.pixel_type, PixelType::float32);
    EXPECT_THAT(file.notes, IsEmpty());
    return file.image.pixels;
  };
  EXPECT_THAT(read(tiff<std::int8_t>({-128, -1, 0, 5, 127}, 2)), ElementsAre(-128, -1, 0, 5, 127));
  EXPECT_THAT(read(tiff<std::int16_t>({-32768, -4280, 0, 136, 32767}, 2)),
              ElementsAre(-32768, -4280, 0, 136, 32767));
  EXPECT_THAT(read(tiff<std::int32_t>({-2147483647 - 1, -70'000, 1, 16'777'216}, 2)),
              ElementsAre(-2147483648.0f, -70'000, 1, 16'777'216));
  EXPECT_THAT(read(tiff<std::uint32_t>({0, 7, 70'000}, 1)), ElementsAre(0, 7, 70'000));
}

TEST_F(ImageValues, WhatAFloatCannotHoldIsSaid) {
  write_text(path("a.tif"), tiff<std::uint32_t>({5, 16'777'217}, 1));
  ImageFile file = read_image(path("a.tif"));
  EXPECT_THAT(file.image.pixels, ElementsAre(5, 16'777'216));
  EXPECT_THAT(file.notes, ElementsAre("uint values were rounded to float, by up to 1"));
  write_text(path("a.tif"), tiff<double>({0.1}, 3));
  EXPECT_THAT(error_of([&] { read_image(path("a.tif")); }),
              HasSubstr("values of type double cannot be read"));
}

TEST_F(ImageValues, UnsignedIntegersOf8And16BitsBecome0To1) {
  write_text(path("a.tif"), tiff<std::uint16_t>({0, 136, 65535}, 1));
  const ImageFile file = read_image(path("a.tif"));
  EXPECT_EQ(file.encoding.pixel_type, PixelType::uint16);
  EXPECT_THAT(file.image.pixels, ElementsAre(0, 136.0f / 65535, 1));
  write_text(path("a.pgm"), std::string("P5\n2 1\n65535\n\x12\x34\x00\x01", 17));
  EXPECT_THAT(read_image(path("a.pgm")).image.pixels, ElementsAre(0x1234 / 65535.0f, 1 / 65535.0f));
}

TEST_F(ImageValues, MarksForMissingDataAreRefused) {
  for (const float mark : {-3.4028235e38f, 1e30f, std::numeric_limits<float>::quiet_NaN()}) {
    write_text(path("a.tif"), tiff<float>({1, 2, mark}, 3));
    EXPECT_THAT(error_of([&] { read_image(path("a.tif")); }),
                HasSubstr("a.tif: the value at x 2, y 0, channel 0 is "));
  }
  write_text(path("a.tif"), tiff<float>({1, 2, -1e29f}, 3));
  EXPECT_EQ(read_image(path("a.tif")).image.pixels.back(), -1e29f);
}

Image row(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size()), 1, 1);
  image.pixels = values;
  return image;
}

TEST_F(ImageValues, HalfClampsAndSaysSo) {
  const auto notes =
      write_image(path("a.exr"), row({-1e6f, -65504, 0.5f, 1e5f}), {PixelType::half, "", {}});
  EXPECT_THAT(read_image(path("a.exr")).image.pixels, ElementsAre(-65504, -65504, 0.5f, 65504));
  EXPECT_THAT(notes, ElementsAre("50 % of the values, which reach from -1e+06 to 1e+05, were "
                                 "clamped to -65504 to 65504"));
}

TEST_F(ImageValues, IntegersSayWhatTheyClamp) {
  EXPECT_THAT(write_image(path("a.png"), row({0, 0.3f, 1, 1 + 1e-3f}), {}), IsEmpty())
      << "this is rounding";
  EXPECT_THAT(write_image(path("a.png"), row({0, -2, 1, 5}), {}),
              ElementsAre("50 % of the values, which reach from -2 to 5, were clamped to 0 to 1"));
  EXPECT_THAT(write_image(path("a.tif"), row({0, -2, 1, 5}), {PixelType::float32, "", {}}),
              IsEmpty());
}

TEST_F(ImageValues, ACoarserTypeIsSaid) {
  const auto notes = [&](const std::string& extension, PixelType type) {
    return write_image(path("a" + extension), row({0, 1}), {type, "", {}});
  };
  EXPECT_THAT(notes(".jpg", PixelType::uint8), IsEmpty());
  EXPECT_THAT(notes(".jpg", PixelType::uint16),
              ElementsAre("uint16 became uint8, the best that a jpeg file has"));
  EXPECT_THAT(notes(".png", PixelType::float32),
              ElementsAre("float became uint16, the best that a png file has"));
  EXPECT_THAT(notes(".tif", PixelType::half), IsEmpty());
  EXPECT_EQ(stored_type(".png", PixelType::half), PixelType::uint16);
  EXPECT_EQ(stored_type(".exr", PixelType::uint16), PixelType::float32);
}

Image transparent() {
  Image image(2, 1, 4);
  image.pixels = {0.2f, 0.4f, 0.6f, 0.6f, 0.8f, 0.2f, 0.0f, 0.0f};
  return image;
}

TEST_F(ImageValues, AlphaIsAssociatedOrNotAsItWas) {
  for (const std::string extension : {".png", ".tif", ".exr", ".tga", ".bmp"})
    for (const bool premultiplied : {false, true}) {
      const Encoding encoding{PixelType::uint8, "", {"R", "G", "B", "A"}, premultiplied};
      const auto notes = write_image(path("a" + extension), transparent(), encoding);
      const ImageFile back = read_image(path("a" + extension));
      for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(back.image.pixels[i], transparent().pixels[i], 3e-4f) << extension;
      if (extension == ".tif") {
        EXPECT_THAT(notes, IsEmpty());
      } else if (premultiplied == (extension == ".exr")) {
        EXPECT_THAT(notes, IsEmpty()) << extension;
      } else {
        EXPECT_THAT(notes, ElementsAre(HasSubstr("multiplied by alpha, which is unusual in a")));
      }
      if (extension != ".tga" && extension != ".bmp") {
        EXPECT_EQ(back.encoding.premultiplied, premultiplied) << extension;
      }
    }
}

TEST_F(ImageValues, ATiffTellsOthersWhichAlphaItHas) {
  // Tag 338, ExtraSamples, one short: 1 is associated, 2 is not.
  for (const bool premultiplied : {false, true}) {
    write_image(path("a.tif"), transparent(),
                {PixelType::uint8, "", {"R", "G", "B", "A"}, premultiplied});
    const std::string bytes = read_text(path("a.tif"));
    const std::string tag("\x52\x01\x03\x00\x01\x00\x00\x00", 8);
    const std::size_t at = bytes.rfind(tag);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(bytes[at + 8], premultiplied ? 1 : 2);
  }
}

TEST_F(ImageValues, ATransparentWebPIsRefusedAndAnOpaqueOneIsRead) {
  write_text(path("a.webp"),
             std::string("\x52\x49\x46\x46\x38\x00\x00\x00\x57\x45\x42\x50\x56\x50\x38\x4c\x2b\x00"
                         "\x00\x00\x2f\x03\x00\x00\x10\x1f\x40\x20\x40\x19\x2b\xb6\x78\x41\x2c\x98"
                         "\x74\xcf\x1f\x25\x40\x21\x01\xe1\x98\xff\x8f\x54\x02\x01\x82\x73\xe7\xa2"
                         "\x7e\xe4\x27\x11\xba\x14\xd1\xff\x00\x00",
                         64));
  EXPECT_THAT(error_of([&] { read_image(path("a.webp")); }),
              HasSubstr("a.webp: a transparent WebP would lose its colours"));
  write_text(path("a.webp"),
             std::string("\x52\x49\x46\x46\x2e\x00\x00\x00\x57\x45\x42\x50\x56\x50\x38\x4c\x21\x00"
                         "\x00\x00\x2f\x03\x00\x00\x00\x17\x40\x20\x40\x19\x2b\xb6\x78\xe1\x0a\xb4"
                         "\x62\xc1\x84\x6c\xfe\x46\xbd\xcd\x7f\xd4\x87\x0f\xaa\x14\xd1\xff\x00\x00",
                         54));
  const Image image = read_image(path("a.webp")).image;
  ASSERT_EQ(image.channels, 3);
  EXPECT_EQ(image.pixels[0], 200.0f / 255);
  EXPECT_EQ(image.pixels[7], 3.0f / 255);
}

TEST_F(ImageValues, DifferencesCountPixelsNotChannels) {
  Image a(4, 1, 2, 0.5f), b = a;
  b.pixels = {0.5f, 0.75f, 0.25f, 0.0f, 0.5f, 0.5078125f, 0.5f, 0.5f};
  const PixelDifference found = difference(a, b, 0.01);
  EXPECT_EQ(found.share, 0.5);
  EXPECT_EQ(found.largest, 0.5);
  EXPECT_EQ(difference(a, b, 0).share, 0.75);
  EXPECT_EQ(difference(a, a, 0).share, 0);
  EXPECT_THROW(difference(a, Image(4, 1, 3), 0), Error);
}

TEST_F(ImageValues, DamagedPngsAreOneLineAndLibpngSaysNothing) {
  testing::internal::CaptureStderr();
  Image image(64, 64, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i * 37 % 256) / 255;
  write_image(path("a.png"), image, {});
  const std::string bytes = read_text(path("a.png"));
  for (std::size_t at = 8; at < bytes.size(); at += 1 + bytes.size() / 100) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    write_text(path("b.png"), damaged);
    try {
      read_image(path("b.png"));
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path("b.png").string() + ": "));
      EXPECT_EQ(std::string(error.what()).find("/proc/"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace gramloom
