#include "io/image_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/random.h"
#include "io/temp_folder.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using ImageFiles = TempFolder;

constexpr auto pixel_types = std::to_array<PixelType>(
    {PixelType::uint8, PixelType::uint16, PixelType::half, PixelType::float32});

/// Random values that `type` holds exactly; floats also beyond [0, 1]. The last channel of 2 or 4,
/// alpha, is 0 in every third pixel.
Image picture(int channels, PixelType type, Size size = {33, 17}) {
  Image image(size, channels);
  Random random(3, static_cast<std::uint64_t>(channels));
  for (float& value : image.pixels) {
    const float k = std::floor(random.uniform() * 65536.0f);
    if (type == PixelType::uint8) value = std::floor(k / 256.0f) / 255.0f;
    if (type == PixelType::uint16) value = k / 65535.0f;
    if (type == PixelType::half) value = (std::floor(k / 64.0f) - 200.0f) / 256.0f;
    if (type == PixelType::float32) value = (k - 1000.0f) / 3000.0f;
  }
  if (channels == 2 || channels == 4)
    for (int i = 0; i < size.width * size.height; i += 3)
      image.at(i % size.width, i / size.width)[channels - 1] = 0.0f;
  return image;
}

struct Case {
  std::string extension;
  PixelType type;
  std::vector<int> channels;
};

const std::vector<int> any{1, 2, 3, 4, 5, 64};
const std::vector<Case> lossless{
    {"png", PixelType::uint8, {1, 2, 3, 4}}, {"png", PixelType::uint16, {1, 2, 3, 4}},
    {"tif", PixelType::uint8, any},          {"tif", PixelType::uint16, any},
    {"tif", PixelType::float32, any},        {"exr", PixelType::half, any},
    {"exr", PixelType::float32, any},        {"tga", PixelType::uint8, {1, 3, 4}},
    {"bmp", PixelType::uint8, {1, 3, 4}},    {"ppm", PixelType::uint8, {1, 3}},
};

TEST_F(ImageFiles, NoOtherFileIsLookedInto) {
  write_image(path("a.png"), picture(3, PixelType::uint8), {});
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(path(""));
  mkfifo("image.png", 0600);  // whoever reads this waits for ever
  mkfifo("png", 0600);
  mkfifo("own", 0600);
  EXPECT_EQ(read_image("a.png").image.width, 33);
  std::filesystem::rename("a.png", "a.own");
  EXPECT_EQ(read_image("a.own").image.width, 33);
  std::filesystem::current_path(before);
}

TEST_F(ImageFiles, EveryFormatTypeAndChannelCountComesBackExactly) {
  for (const auto& [extension, type, channels] : lossless)
    for (const int count : channels) {
      const Image image = picture(count, type);
      const auto name = path("a." + extension);
      write_image(name, image, {type, "", {}});
      const ImageFile file = read_image(name);
      EXPECT_EQ(file.image, image) << extension << ' ' << to_word(type) << ' ' << count;
      EXPECT_EQ(file.encoding.pixel_type, type) << extension << ' ' << count;
    }
}

TEST_F(ImageFiles, ColourUnderZeroAlphaIsKept) {
  for (const std::string extension : {"png", "tif", "exr", "tga", "bmp"})
    for (const PixelType type : pixel_types) {
      Image image(4, 4, 4, 1.0f);
      for (std::size_t i = 3; i < image.pixels.size(); i += 4)
        image.pixels[i] = static_cast<float>(i / 16) / 5.0f;  // alpha 0, 0.2, 0.4, 0.6
      const auto name = path("a." + extension);
      write_image(name, image, {type, "sRGB", {"R", "G", "B", "A"}});
      const Image back = read_image(name).image;
      ASSERT_EQ(back.channels, 4);
      for (std::size_t i = 0; i < image.pixels.size(); ++i)
        EXPECT_NEAR(back.pixels[i], image.pixels[i], 3e-4f) << extension << ' ' << to_word(type);
    }
}

TEST_F(ImageFiles, PixelTypesThatAFormatLacksBecomeBetterOnes) {
  const auto stored = [&](const std::string& extension, PixelType type) {
    const auto name = path("a." + extension);
    write_image(name, picture(3, PixelType::uint8), {type, "", {}});
    const ImageFile file = read_image(name);
    EXPECT_EQ(file.image.channels, 3);
    for (std::size_t i = 0; i < file.image.pixels.size(); ++i)
      EXPECT_NEAR(file.image.pixels[i], picture(3, PixelType::uint8).pixels[i], 3e-4f);
    return file.encoding.pixel_type;
  };
  EXPECT_EQ(stored("png", PixelType::half), PixelType::uint16);
  EXPECT_EQ(stored("png", PixelType::float32), PixelType::uint16);
  EXPECT_EQ(stored("tif", PixelType::half), PixelType::float32);
  EXPECT_EQ(stored("exr", PixelType::uint8), PixelType::half);
  EXPECT_EQ(stored("exr", PixelType::uint16), PixelType::float32);
  EXPECT_EQ(stored("tga", PixelType::float32), PixelType::uint8);
}

TEST_F(ImageFiles, IntegersClampAndRoundToNearest) {
  Image image(5, 1, 1);
  image.pixels = {-0.3f, 7.0f, 100.4f / 255, 100.6f / 255, 1.0f};
  write_image(path("a.png"), image, {});
  EXPECT_EQ(read_image(path("a.png")).image.pixels,
            (std::vector<float>{0.0f, 1.0f, 100.0f / 255, 101.0f / 255, 1.0f}));
}

TEST_F(ImageFiles, NamesColourSpaceAndMetadataComeBack) {
  const Metadata metadata{{"gramloom:settings", R"({"seed": 7, "text": "a\nb \"c\" ü"})"},
                          {"ImageDescription", "our own"},
                          {"empty", ""},
                          {"DateTime", "2001:02:03 04:05:06"},
                          {"long", std::string(5000, 'x')}};
  for (const std::string extension : {"png", "jpg", "tif", "exr"})
    for (const std::string colour_space : {"", "sRGB", "linear", "ACEScg"})
      for (const std::vector<std::string>& names :
           {std::vector<std::string>{"R", "G", "B"}, {"height", "B", "a.name"}}) {
        const auto name = path("a." + extension);
        const Encoding encoding{PixelType::uint8, colour_space, names};
        const Image image = picture(3, PixelType::uint8);
        write_image(name, image, encoding, metadata);
        const ImageFile file = read_image(name);
        EXPECT_EQ(file.metadata, metadata) << extension;
        EXPECT_EQ(file.encoding.colour_space, colour_space) << extension;
        EXPECT_EQ(file.encoding.channel_names, names) << extension;
        for (std::size_t i = 0; i < image.pixels.size() && extension != "jpg"; ++i)
          EXPECT_NEAR(file.image.pixels[i], image.pixels[i], 3e-4f) << extension;
      }
}

TEST_F(ImageFiles, NamesWithoutOneForEachChannelGoByCount) {
  const auto names = [&](int channels) {
    write_image(path("a.exr"), picture(channels, PixelType::half), {PixelType::half, "", {"only"}});
    return read_image(path("a.exr")).encoding.channel_names;
  };
  EXPECT_EQ(names(1), (std::vector<std::string>{"only"}));
  EXPECT_EQ(names(2), (std::vector<std::string>{"Y", "A"}));
  EXPECT_EQ(names(3), (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(names(5), (std::vector<std::string>{"R", "G", "B", "A", "channel4"}));
  EXPECT_THAT(
      error_of([&] {
        write_image(path("a.exr"), picture(2, PixelType::half), {PixelType::half, "", {"x", "x"}});
      }),
      HasSubstr("the same name"));
}

TEST_F(ImageFiles, JpegIsClose) {
  Image image({64, 64}, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = 0.5f + 0.4f * std::sin(static_cast<float>(x * (c + 1) + y) / 8.0f);
  write_image(path("a.jpg"), image, {});
  const Image back = read_image(path("a.jpg")).image;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    ASSERT_NEAR(back.pixels[i], image.pixels[i], 0.03f);
}

TEST_F(ImageFiles, TheSameImageGivesTheSameBytesOnAnotherDay) {
  for (const std::string extension : {"png", "jpg", "tif", "exr"}) {
    const auto name = path("a." + extension);
    write_image(name, picture(3, PixelType::uint8), {}, {{"k", "v"}});
    const std::string once = read_text(name);
    write_image(name, picture(3, PixelType::uint8), {}, {{"k", "v"}});
    EXPECT_TRUE(read_text(name) == once) << extension;
    // A date in these formats reads "2026:01:31 …".
    for (int year = 2020; year < 2100; ++year)
      EXPECT_EQ(once.find(std::to_string(year) + ":"), std::string::npos) << extension;
  }
}

// --- what others write
// ------------------------------------------------------------------------------

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string png_chunk(const std::string& type_and_data) {
  std::uint32_t crc = ~0u;
  for (const char byte : type_and_data) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1)));
  }
  return big_endian(static_cast<std::uint32_t>(type_and_data.size() - 4)) + type_and_data +
         big_endian(~crc);
}

/// A PNG of one scanline's bytes, stored without compression.
std::string png(std::uint32_t width, std::uint32_t height, char depth, char colour_type,
                const std::string& before_data, const std::string& scanlines) {
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char byte : scanlines) {
    a = (a + static_cast<std::uint8_t>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const auto length = static_cast<std::uint16_t>(scanlines.size());
  std::string data("\x78\x01\x01", 3);
  for (const unsigned part : {unsigned{length}, ~unsigned{length}}) {
    data.push_back(static_cast<char>(part));
    data.push_back(static_cast<char>(part >> 8));
  }
  data += scanlines + big_endian(b << 16 | a);
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR" + big_endian(width) + big_endian(height) + depth + colour_type +
                   std::string(3, '\0')) +
         before_data + png_chunk("IDAT" + data) + png_chunk("IEND");
}

TEST_F(ImageFiles, PalettesAreExpanded) {
  const std::string palette = png_chunk(std::string("PLTE\xff\x00\x00\x00\x33\xff", 10));
  const std::string opacity = png_chunk(std::string("tRNS\x00\xff", 6));
  // One byte of filter, then eight pixels of one bit: 10100000.
  write_text(path("a.png"), png(3, 1, 1, 3, palette, std::string("\0\xa0", 2)));
  EXPECT_EQ(read_image(path("a.png")).image.pixels,
            (std::vector<float>{0, 0.2f, 1, 1, 0, 0, 0, 0.2f, 1}));
  write_text(path("a.png"), png(3, 1, 1, 3, palette + opacity, std::string("\0\xa0", 2)));
  EXPECT_EQ(read_image(path("a.png")).image.pixels,
            (std::vector<float>{0, 0.2f, 1, 1, 1, 0, 0, 0, 0, 0.2f, 1, 1}));
}

TEST_F(ImageFiles, GrayOfFewBitsFillsTheRange) {
  write_text(path("a.png"), png(4, 1, 2, 0, "", std::string("\0\x1b", 2)));  // 0, 1, 2, 3
  EXPECT_EQ(read_image(path("a.png")).image.pixels,
            (std::vector<float>{0, 85.0f / 255, 170.0f / 255, 1}));
}

TEST_F(ImageFiles, TextsOfOthersComeAlong) {
  write_text(path("a.png"), png(1, 1, 8, 0, png_chunk(std::string("tEXtAuthor\0somebody", 19)),
                                std::string("\0\x80", 2)));
  EXPECT_EQ(read_image(path("a.png")).metadata, (Metadata{{"Artist", "somebody"}}));
}

TEST_F(ImageFiles, TheFormatIsKnownByItsContent) {
  write_image(path("a.jpg"), picture(3, PixelType::uint8), {});
  std::filesystem::rename(path("a.jpg"), path("really a jpeg.png"));
  EXPECT_EQ(read_image(path("really a jpeg.png")).image.size(), (Size{33, 17}));
}

TEST_F(ImageFiles, CamerasThatAreHeldSidewaysTurnTheirPictures) {
  // The same two pixels in a TIFF whose orientation tag (274, a short) we change.
  Image image(3, 2, 1);
  image.pixels = {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f};
  write_image(path("a.tif"), image, {});
  std::string tiff = read_text(path("a.tif"));
  const std::size_t tag = tiff.rfind(std::string("\x12\x01\x03\x00\x01\x00\x00\x00", 8));
  ASSERT_NE(tag, std::string::npos);
  const auto seen = [&](char orientation) {
    tiff[tag + 8] = orientation;
    write_text(path("a.tif"), tiff);
    const Image turned = read_image(path("a.tif")).image;
    EXPECT_EQ(turned.width, orientation < 5 ? 3 : 2);
    std::vector<int> fifths;
    for (const float value : turned.pixels) fifths.push_back(static_cast<int>(value * 5 + 0.5f));
    return fifths;
  };
  using Fifths = std::vector<int>;
  EXPECT_EQ(seen(1), (Fifths{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(seen(2), (Fifths{2, 1, 0, 5, 4, 3}));
  EXPECT_EQ(seen(3), (Fifths{5, 4, 3, 2, 1, 0}));
  EXPECT_EQ(seen(4), (Fifths{3, 4, 5, 0, 1, 2}));
  EXPECT_EQ(seen(5), (Fifths{0, 3, 1, 4, 2, 5}));
  EXPECT_EQ(seen(6), (Fifths{3, 0, 4, 1, 5, 2}));
  EXPECT_EQ(seen(7), (Fifths{5, 2, 4, 1, 3, 0}));
  EXPECT_EQ(seen(8), (Fifths{2, 5, 1, 4, 0, 3}));
}

// --- damage
// -----------------------------------------------------------------------------------------

TEST_F(ImageFiles, TruncatedAnywhereIsAnErrorNotGrayPixels) {
  for (const std::string extension : {"png", "jpg", "tif", "exr", "bmp", "ppm", "hdr"}) {
    const auto whole = path("whole." + extension), part = path("part." + extension);
    write_image(whole, picture(3, PixelType::uint8, {48, 40}), {});
    const std::string bytes = read_text(whole);
    for (std::size_t length = 0; length < bytes.size();
         length += 1 + (length + 60 < bytes.size() ? bytes.size() / 40 : 0)) {
      write_text(part, bytes.substr(0, length));
      const std::string error = error_of([&] { read_image(part); });
      EXPECT_EQ(error.find(part.string() + ": "), 0u) << error;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
}

TEST_F(ImageFiles, DamagedBytesNeverCrash) {
  Random random(9);
  for (const std::string extension : {"png", "jpg", "tif", "exr", "tga", "bmp", "ppm"}) {
    const auto name = path("a." + extension);
    write_image(name, picture(3, PixelType::uint8), {});
    const std::string bytes = read_text(name);
    for (int round = 0; round < 40; ++round) {
      std::string damaged = bytes;
      const std::size_t reach = round % 2 == 0 ? damaged.size() : damaged.size() / 4;
      for (int i = 0; i < 4; ++i)
        damaged[random.below(static_cast<std::uint32_t>(reach))] = static_cast<char>(random.bits());
      write_text(name, damaged);
      try {
        read_image(name);
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  }
}

TEST_F(ImageFiles, HeadersThatClaimTooMuchAreRefusedBeforeAllocating) {
  const auto refused = [&](const std::string& name, const std::string& bytes) {
    write_text(path(name), bytes);
    EXPECT_THAT(error_of([&] { read_image(path(name)); }), HasSubstr("the header claims ")) << name;
  };
  const std::string rest(1000, '\0');
  refused("a.png", png(50'000, 40'000, 8, 2, "", rest));
  refused("b.png", png(1'000'000, 1'000'000, 16, 6, "", rest));
  refused("a.ppm", "P6\n50000 40000\n255\n" + rest);
  refused("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 50000\n" + rest);

  write_image(path("a.jpg"), picture(3, PixelType::uint8), {});
  std::string jpeg = read_text(path("a.jpg"));
  const std::size_t frame = jpeg.find("\xff\xc0");
  jpeg.replace(frame + 5, 4, "\xff\x00\xff\x00", 4);
  refused("a.jpg", jpeg);

  write_image(path("a.tif"), picture(3, PixelType::uint8), {});
  std::string tiff = read_text(path("a.tif"));
  for (const char tag : {'\0', '\1'}) {  // 256: width, 257: height; type 3: 16 bits
    const std::size_t at = tiff.rfind(std::string({tag, 1, 3, 0, 1, 0, 0, 0}));
    ASSERT_NE(at, std::string::npos);
    tiff.replace(at + 8, 2, "\xff\xff");
  }
  refused("a.tif", tiff);

  write_image(path("a.exr"), picture(3, PixelType::half), {});
  std::string exr = read_text(path("a.exr"));
  for (const std::string window : {"dataWindow", "displayWindow"}) {
    const std::size_t at = exr.find(window + std::string("\0box2i\0", 7)) + window.size() + 11;
    for (const std::size_t side : {at + 8, at + 12}) exr.replace(side, 4, "\x4f\xc3\x00\x00", 4);
  }
  write_text(path("a.exr"), exr);
  EXPECT_NE(error_of([&] { read_image(path("a.exr")); }), "");
}

TEST_F(ImageFiles, FilesThatAreNoImages) {
  const auto error = [&](const std::string& name) {
    return error_of([&] { read_image(path(name)); });
  };
  EXPECT_EQ(error("none.png"),
            path("none.png").string() + ": cannot read: No such file or directory");
  std::filesystem::create_directory(path("folder.png"));
  EXPECT_EQ(error("folder.png"), path("folder.png").string() + ": cannot read: Is a directory");
  write_text(path("empty.png"), "");
  EXPECT_EQ(error("empty.png"), path("empty.png").string() + ": the file is empty");
  for (const std::string name : {"text.png", "text.txt", "text.toml", "text.null", "text.exr"}) {
    write_text(path(name), "this is a text\n");
    EXPECT_THAT(error(name), HasSubstr(name + ": not an image")) << name;
  }
}

TEST_F(ImageFiles, NotANumberIsNamedWithItsPlace) {
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    Image image(5, 4, 3);
    write_image(path("a.tif"), image, {PixelType::float32, "", {}});
    image.at(3, 2)[1] = value;
    EXPECT_THAT(error_of([&] {
                  write_image(path("a.tif"), image, {PixelType::float32, "", {}});
                }),
                HasSubstr("a.tif: the value at x 3, y 2, channel 1 is "));
    EXPECT_EQ(read_image(path("a.tif")).image, Image(5, 4, 3));
  }
  // A PFM as others write it: bottom row first.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string pfm = "PF\n2 2\n-1.0\n" + std::string(48, '\0');
  std::memcpy(pfm.data() + pfm.size() - 4, &nan, 4);
  write_text(path("a.pfm"), pfm);
  EXPECT_THAT(error_of([&] { read_image(path("a.pfm")); }),
              HasSubstr("a.pfm: the value at x 1, y 0, channel 2 is "));
}

TEST_F(ImageFiles, WhatAFormatCannotHoldIsAnErrorThatLeavesTheOldFile) {
  const auto error = [&](const std::string& name, int channels, const Metadata& metadata = {}) {
    write_text(path(name), "old");
    const std::string text = error_of(
        [&] { write_image(path(name), picture(channels, PixelType::uint8), {}, metadata); });
    EXPECT_EQ(text.find(path(name).string() + ": "), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_EQ(read_text(path(name)), "old");
    return text;
  };
  EXPECT_THAT(error("a.jpg", 4), HasSubstr("a jpeg file cannot hold 4 channels"));
  EXPECT_THAT(error("a.jpg", 2), HasSubstr("cannot hold 2 channels"));
  EXPECT_THAT(error("a.png", 5), HasSubstr("a png file cannot hold 5 channels"));
  EXPECT_THAT(error("a.png", 64), HasSubstr("cannot hold 64 channels"));
  EXPECT_THAT(error("a.hdr", 1), HasSubstr("cannot hold 1 channel;"));
  EXPECT_THAT(error("a.webp", 3), HasSubstr("extension '.webp'"));
  EXPECT_THAT(error("a.txt", 3), HasSubstr("extension '.txt'"));
  EXPECT_THAT(error("noextension", 3), HasSubstr("extension ''"));
  EXPECT_THAT(error_of([&] { write_image(path("a.jpg"), Image(65501, 1, 1), {}); }),
              HasSubstr("65501×1 pixels"));
  EXPECT_THAT(error("a.jpg", 3, {{"k", std::string(70'000, 'x')}}), HasSubstr("metadata"));
  EXPECT_EQ(error_of([&] { write_image(path("none/a.png"), picture(3, PixelType::uint8), {}); }),
            path("none/a.png").string() + ": cannot write: No such file or directory");
  EXPECT_THAT(error_of([&] { write_image(path("a.png"), Image(), {}); }), HasSubstr("empty image"));
}

}  // namespace
}  // namespace gramloom
