// Exported generators make the pictures that ours makes.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <opencv2/dnn.hpp>

#include "core/error.h"
#include "io/text_file.h"
#include "learnt/export_c.h"
#include "learnt/export_glsl.h"
#include "learnt/export_onnx.h"
#include "learnt/generator.h"
#include "learnt/noise.h"
#include "learnt/some_generator.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::uint32_t seed = 3000000007u;  // all bits count

struct Case {
  GeneratorModel model;
  std::vector<float> shares{1.0f};
};

// One level and many, layers and channels that fill no vector, maps, materials.
std::vector<Case> cases() {
  std::vector<Case> all{{some_generator({{4, 8, 1}})},
                        {some_generator({{8, 16, 3}, {4, 16, 2}, {4, 8, 1}})},
                        {some_generator({{4, 5, 2}, {8, 11, 2}}, 6)},
                        {some_generator({{4, 4, 3}, {4, 9, 3}}, 1)}};
  all.push_back({some_generator({{8, 8, 2}, {4, 12, 3}}, 3, 3), {0.5f, 0.2f, 0.3f}});
  return all;
}

Image made(const Case& one, Size size, Tile tile) {
  return generate(one.model, {size, tile, seed, one.shares, {}}, {});
}
PlainGenerator plain(const Case& one) { return plain_generator(one.model, one.shares); }

// The largest difference, in shares of the channel's range.
double difference(const Image& a, const Image& b, const Case& one) {
  const auto &low = one.model.values("colours.low"), &high = one.model.values("colours.high");
  double most = a.size() == b.size() && a.channels == b.channels ? 0 : 1e9;
  for (std::size_t i = 0; i < a.pixels.size() && most < 1e9; ++i) {
    const std::size_t c = i % low.size();
    most = std::max<double>(most, std::abs(a.pixels[i] - b.pixels[i]) / (high[c] - low[c]));
  }
  return most;
}

class Export : public testing::Test {
 protected:
  Export() : folder_(fs::temp_directory_path() / fmt::format("gramloom_export_{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~Export() override { fs::remove_all(folder_); }

  void compile(const std::string& options, const std::string& output) const {
    const std::string command = fmt::format(
        "cd '{}' && '{}' -x c -std=c99 -pedantic -Wall -Wextra -Werror {} -o {} it.c 2> errors",
        folder_.string(), GRAMLOOM_COMPILER, options, output);
    ASSERT_EQ(std::system(command.c_str()), 0) << read_text(folder_ / "errors");
  }

  const fs::path folder_;
};

// A function of an exported file, compiled.
class Compiled {
 public:
  explicit Compiled(const fs::path& file) : library_(dlopen(file.c_str(), RTLD_NOW)) {
    if (!library_) throw Error("{}", dlerror());
  }
  ~Compiled() { dlclose(library_); }
  Compiled(const Compiled&) = delete;
  template <class Function>
  Function* at(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(library_, name));
  }

 private:
  void* library_;
};
using Generate = int(float*, int, int, unsigned, int);
using Part = int(float*, int, int, int, int, int, int, unsigned, int);

int tile_bits(Tile tile) { return (tiles_x(tile) ? 1 : 0) + (tiles_y(tile) ? 2 : 0); }

TEST_F(Export, CMakesOurPictures) {
  int number = 0;
  for (const Case& one : cases()) {
    write_text(folder_ / "it.c", export_c(plain(one), "it", "test"));
    const std::string name = fmt::format("{}", number++);
    compile("-O2 -shared -fPIC", name + ".so");
    compile("-O1 -shared -fPIC -DGRAMLOOM_NO_VECTORS", name + "plain.so");
    const Compiled it(folder_ / (name + ".so")), plain(folder_ / (name + "plain.so"));
    for (const auto& [size, tile] : {std::pair{Size{1, 1}, Tile::both},
                                     {{37, 50}, Tile::none},
                                     {{37, 50}, Tile::both},
                                     {{201, 3}, Tile::x},
                                     {{201, 3}, Tile::y}}) {
      const Image ours = made(one, size, tile);
      for (const Compiled* compiled : {&it, &plain}) {
        Image image(size, one.model.description.channels);
        ASSERT_EQ(compiled->at<Generate>("it_generate")(image.pixels.data(), size.width,
                                                        size.height, seed, tile_bits(tile)),
                  0);
        EXPECT_LT(difference(image, ours, one), export_c_tolerance)
            << name << " " << size.width << " " << to_word(tile);
      }
    }
  }
}

TEST_F(Export, CMakesPartsAndRefusesWhatHasNoPixels) {
  const Case one = cases()[1];
  write_text(folder_ / "it.c", export_c(plain(one), "it", "test"));
  compile("-O2 -shared -fPIC", "it.so");
  const Compiled it(folder_ / "it.so");
  const Image whole = made(one, {60, 44}, Tile::both);
  Image part({21, 13}, 3);
  const auto make = it.at<Part>("it_part");
  ASSERT_EQ(make(part.pixels.data(), 31, 30, 21, 13, 60, 44, seed, 3), 0);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(part.at(x, y)[c], whole.at(x + 31, y + 30)[c], export_c_tolerance);
  EXPECT_EQ(it.at<Generate>("it_generate")(nullptr, 0, 5, seed, 0), 1);
  EXPECT_EQ(make(nullptr, 0, 0, 4, 4, -3, 4, seed, 1), 1);
}

TEST_F(Export, CIsAProgramToo) {
  const Case one = cases()[1];
  write_text(folder_ / "it.c", export_c(plain(one), "it", "test"));
  compile("-O2 -DGRAMLOOM_MAIN", "it");
  const auto run = [&](const std::string& words) {
    return WEXITSTATUS(
        std::system(fmt::format("cd '{}' && ./it {} 2> errors", folder_.string(), words).c_str()));
  };
  const Size size{31, 22};
  ASSERT_EQ(run(fmt::format("31 22 {} 1 it.pfm", seed)), 0);
  const std::string bytes = read_text(folder_ / "it.pfm");
  ASSERT_EQ(bytes.substr(0, 15), "PF\n31 22\n-1.0\n" + bytes.substr(14, 1));
  Image image(size, 3);
  for (int y = 0; y < size.height; ++y)
    std::memcpy(image.at(0, size.height - 1 - y),
                &bytes[14 + 12 * 31 * static_cast<std::size_t>(y)], 12 * 31);
  EXPECT_LT(difference(image, made(one, size, Tile::x), one), export_c_tolerance);
  ASSERT_EQ(run(fmt::format("31 22 {} 1 it.ppm", seed)), 0);
  const std::string small = read_text(folder_ / "it.ppm");
  ASSERT_EQ(small.size(), 13u + 31 * 22 * 3);
  EXPECT_NEAR(static_cast<unsigned char>(small[13]), *image.at(0, 0) * 255, 0.51);
  EXPECT_EQ(run("31 22 1 1"), 2);
  EXPECT_EQ(run("31 22 1 1 nowhere/it.ppm"), 1);
  EXPECT_THAT(read_text(folder_ / "errors"), HasSubstr("nowhere/it.ppm"));
}

TEST_F(Export, TextsOfTheModelEndNoComment) {
  Case one = cases()[0];
  one.model.description.materials[0] = {"*/ #error \n/*/ \\", "", "\n#error */"};
  const std::string text = export_c(plain(one), "it", "test");
  write_text(folder_ / "it.c", text);
  compile("-O0 -c", "it.o");
  const std::string shaders = export_glsl(plain(one), "test");
  EXPECT_EQ(shaders.find("*/"), shaders.find(" */\n\nprecision") + 1);
}

TEST_F(Export, NumbersAreReadBackAsTheyWere) {
  for (const float value : {0.0f, -0.0f, 1.0f, -1.0f, 0.1f, -0.5f, 1e-30f, -3.4e38f, 16777216.0f,
                            0.333333343f, 1e-7f}) {
    const std::string text = float_constant(value);
    EXPECT_EQ(std::stof(text), value) << text;
    EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text;
  }
}

// The noise of a level as OpenCV's dnn wants it; `wrap`: the level's size, 0 where it has no end.
cv::Mat noise_of(int k, int channels, const OnnxFrame& across, const OnnxFrame& down, Size wrap) {
  const int shape[] = {1, channels, down.length << k, across.length << k};
  cv::Mat noise(4, shape, CV_32F);
  const auto place = [](int at, int length) {
    return static_cast<std::uint32_t>(length == 0 ? at : ((at % length) + length) % length);
  };
  for (int row = 0; row < shape[2]; ++row)
    for (int column = 0; column < shape[3]; ++column)
      for (int c = 0; c < channels; ++c) {
        const int at[] = {0, c, row, column};
        const auto words = pcg4d(place(across.first * (1 << k) + column, wrap.width),
                                 place(down.first * (1 << k) + row, wrap.height), seed,
                                 static_cast<std::uint32_t>(noise_groups_per_level * k + c / 4));
        noise.at<float>(at) = noise_value(words[static_cast<std::size_t>(c % 4)]);
      }
  return noise;
}

Image picture_of(const cv::Mat& output, int left, int top, Size size) {
  Image image(size, output.size[1]);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        const int at[] = {0, c, y + top, x + left};
        image.at(x, y)[c] = output.at<float>(at);
      }
  return image;
}

TEST_F(Export, OnnxMakesOurPicturesInOpenCv) {
  // Its reader of 4.10, Debian 13's, wants to know all sizes of a network when it reads it.
  if (cv::getVersionMajor() * 100 + cv::getVersionMinor() >= 410)
    GTEST_SKIP() << "OpenCV " << cv::getVersionString() << " reads no network of any size";
  for (const Case& one : cases()) {
    const PlainGenerator generator = plain(one);
    const std::string bytes = export_onnx(generator, "test");
    const int levels = generator.level_count();
    for (const Size size : {Size{1, 1}, {37, 50}, {64, 16}})
      for (const Tile tile : {Tile::none, Tile::both}) {
        if (tile == Tile::both && size.width % (1 << (levels - 1)) != 0) continue;
        if (tile == Tile::both && size.height % (1 << (levels - 1)) != 0) continue;
        const OnnxFrame across = onnx_frame(generator, size.width);
        const OnnxFrame down = onnx_frame(generator, size.height);
        cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
        for (int k = 0; k < levels; ++k) {
          const int share = 1 << (levels - 1 - k);
          const Size wrap =
              tile == Tile::both ? Size{size.width / share, size.height / share} : Size{0, 0};
          net.setInput(
              noise_of(k, generator.levels[static_cast<std::size_t>(k)].noise, across, down, wrap),
              fmt::format("noise_{}", k));
        }
        const cv::Mat output = net.forward("picture");
        const Image image = picture_of(output, across.skipped, down.skipped, size);
        EXPECT_LT(difference(image, made(one, size, tile), one), 1e-4)
            << levels << " levels, " << size.width << " " << to_word(tile);
      }
  }
}

// In the runtime itself, by the example that shows how, where the environment says in which folder
// npm has installed it.
TEST_F(Export, OnnxMakesOurPicturesInOnnxRuntime) {
  const char* installed = std::getenv("GRAMLOOM_ONNXRUNTIME");
  if (!installed)
    GTEST_SKIP() << "GRAMLOOM_ONNXRUNTIME names no folder with node_modules/onnxruntime-node";
  for (const Case& one : cases()) {
    if (one.model.description.channels != 3) continue;
    write_text(folder_ / "it.onnx", export_onnx(plain(one), "test"));
    for (const Tile tile : {Tile::none, Tile::x, Tile::both}) {
      const Size size{36, 52};
      const std::string command = fmt::format(
          "cd '{}' && node '{}' '{}/it.onnx' {} {} {} {} '{}/it.pfm' > '{}/errors' 2>&1", installed,
          (source_folder() / "examples/generator_onnx.mjs").string(), folder_.string(), size.width,
          size.height, seed, tile_bits(tile), folder_.string(), folder_.string());
      ASSERT_EQ(std::system(command.c_str()), 0) << read_text(folder_ / "errors");
      const std::string bytes = read_text(folder_ / "it.pfm");
      Image image(size, 3);
      const auto row = static_cast<std::size_t>(size.width) * 12;
      for (int y = 0; y < size.height; ++y)
        std::memcpy(image.at(0, size.height - 1 - y),
                    &bytes[bytes.size() - row * static_cast<std::size_t>(size.height - y)], row);
      EXPECT_LT(difference(image, made(one, size, tile), one), 1e-4) << to_word(tile);
    }
  }
}

}  // namespace
}  // namespace gramloom
