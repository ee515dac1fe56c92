// What directs a texture, from the config to the request: masks, guides, weights, holes.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "io/text_file.h"
#include "jobs/arrangement.h"
#include "jobs/listing.h"
#include "jobs/loaded_request.h"
#include "jobs/plan.h"
#include "jobs/settings.h"
#include "jobs/usable_part.h"
#include "metrics/seams.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string method = "[[method]]\nname = 'p'\nkind = 'patchmatch'\n";

class DirectionOfConfig : public testing::Test {
 protected:
  DirectionOfConfig()
      : folder_(fs::temp_directory_path() / fmt::format("gramloom_direction_{}", getpid())) {
    fs::create_directories(folder_);
    write("e.png", Image(32, 24, 3, 0.5f));
    write("f.png", Image(20, 20, 3, 0.25f));
    write("black.png", Image(32, 24, 1));
    write("white.png", Image(32, 24, 1, 1.0f));
    write("small.png", Image(8, 8, 1));
    write("hole.png", picture({32, 24}, 1, [](int x, int) { return x < 10 ? 1.0f : 0.0f; }));
    write("left.png", picture({32, 24}, 1, [](int x, int) { return x < 16 ? 1.0f : 0.0f; }));
    write("two.png", picture({32, 24}, 1, [](int x, int) { return x < 16 ? 0.2f : 0.8f; }));
    write("three.png", picture({40, 30}, 1, [](int x, int) {
            return 0.2f + 0.3f * static_cast<float>(x / 14);
          }));
    Image clear(8, 8, 4, 1.0f);
    clear.at(3, 0)[3] = 0.2f;
    clear.at(4, 0)[3] = 0.8f;
    write("clear.png", clear);
    write("both.png", picture({40, 30}, 1, [](int x, int) { return x < 20 ? 0.8f : 0.2f; }));
  }
  ~DirectionOfConfig() override { fs::remove_all(folder_); }

  static Image picture(Size size, int channels, const std::function<float(int, int)>& value) {
    Image image(size, channels);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < channels; ++c) image.at(x, y)[c] = value(x, y);
    return image;
  }
  void write(const std::string& name, const Image& image, const Encoding& encoding = {}) const {
    write_image(folder_ / name, image, encoding);
  }
  Config parse(const std::string& text) const {
    return parse_config(text + method, folder_ / "a.toml");
  }
  LoadedRequest load(const std::string& text) const { return load_request(parse(text), 0); }

  // What the error says, without the folder's name.
  std::string complaint(const std::string& text) const {
    try {
      make_plan(parse(text));
    } catch (const ConfigError& error) {
      std::string message = error.what();
      const std::string prefix = folder_.string() + "/";
      for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
        message.erase(at, prefix.size());
      return message;
    }
    return "";
  }

  const fs::path folder_;
};

TEST_F(DirectionOfConfig, SeveralPicturesAreOneMaterial) {
  const LoadedRequest loaded =
      load("[[exemplar]]\nname = 'e'\nimages = ['e.png', { image = 'f.png' }]\nmax_side = 16\n");
  ASSERT_EQ(loaded.exemplars.size(), 2u);
  EXPECT_EQ(loaded.exemplars[0].image.size(), (Size{16, 12}));
  EXPECT_EQ(loaded.exemplars[1].image.size(), (Size{16, 16}));
}

TEST_F(DirectionOfConfig, AFolderAmongImagesIsItsPictures) {
  fs::create_directories(folder_ / "more");
  write("more/a.png", Image(9, 9, 3));
  write("more/b.png", Image(8, 9, 3));
  const LoadedRequest loaded = load("[[exemplar]]\nname = 'e'\nimages = ['more', 'e.png']\n");
  ASSERT_EQ(loaded.exemplars.size(), 3u);
  EXPECT_EQ(loaded.exemplars[1].image.width, 8);
}

TEST_F(DirectionOfConfig, MapsOfSeveralPicturesHaveOneRange) {
  const Encoding floats{PixelType::float32, "", {}};
  write("eh.exr", Image(32, 24, 1, 3.0f), floats);
  write("fh.exr", Image(20, 20, 1, 5.0f), floats);
  const LoadedRequest loaded = load(
      "[[exemplar]]\nname = 'e'\nimages = [{ image = 'e.png', maps = { height = 'eh.exr' } }, "
      "{ image = 'f.png', maps = { height = 'fh.exr' } }]\n");
  EXPECT_EQ(loaded.exemplars[0].image.pixels[3], 0);
  EXPECT_EQ(loaded.exemplars[1].image.pixels[3], 1);
  EXPECT_EQ(loaded.files[1].low, 3);
  EXPECT_EQ(loaded.files[1].high, 5);
}

TEST_F(DirectionOfConfig, AMaskOrAlphaSaysWhatMayBeUsed) {
  const std::string one = "[[exemplar]]\nname = 'e'\n";
  EXPECT_EQ(load(one + "image = 'e.png'\nmask = 'hole.png'\n").exemplars[0].mask.pixels[5], 1);
  EXPECT_EQ(load(one + "image = 'e.png'\nmask = 'hole.png'\n").exemplars[0].mask.pixels[15], 0);
  const Image mask = load(one + "image = 'clear.png'\nmask = 'alpha'\n").exemplars[0].mask;
  EXPECT_EQ(mask.pixels[2], 1);
  EXPECT_EQ(mask.pixels[3], 0);
}

TEST_F(DirectionOfConfig, AFilledPictureIsItsOwnExemplarWithoutTheHole) {
  const Config config =
      parse("[fill]\nimage = 'e.png'\nmask = 'hole.png'\nextend = [0, 0, 4, 2]\n");
  EXPECT_EQ(config.size, (Size{36, 26}));
  ASSERT_EQ(config.exemplars.size(), 1u);
  EXPECT_EQ(config.exemplars[0].name, "e");
  const LoadedRequest loaded = load_request(config, 0);
  EXPECT_EQ(loaded.exemplars[0].image.size(), (Size{32, 24}));
  EXPECT_EQ(*loaded.exemplars[0].mask.at(9, 0), 0);
  EXPECT_EQ(*loaded.exemplars[0].mask.at(10, 0), 1);
  EXPECT_EQ(loaded.target.mask.size(), (Size{36, 26}));
  EXPECT_EQ(*loaded.target.mask.at(9, 23), 1);
  EXPECT_EQ(*loaded.target.mask.at(31, 23), 0);
  EXPECT_EQ(*loaded.target.mask.at(32, 0), 1);
  EXPECT_EQ(*loaded.target.mask.at(20, 24), 1);
}

TEST_F(DirectionOfConfig, PicturesWithAndWithoutAlphaAreOneMaterial) {
  const LoadedRequest both = load("[[exemplar]]\nname = 'e'\nimages = ['e.png', 'clear.png']\n");
  ASSERT_EQ(both.exemplars[0].image.channels, 4);
  EXPECT_EQ(both.exemplars[0].image.at(31, 23)[2], read_image(folder_ / "e.png").image.pixels[0]);
  EXPECT_EQ(both.exemplars[0].image.at(31, 23)[3], 1);
  EXPECT_EQ(both.exemplars[0].layers, both.exemplars[1].layers);
  EXPECT_EQ(both.files[0].channels, 4);
  EXPECT_EQ(both.files[0].encoding.channel_names.back(), "A");
  EXPECT_THAT(both.notes, testing::ElementsAre("e.png: taken as opaque beside clear.png"));

  write("grey.png", Image(16, 16, 1, 0.5f));
  EXPECT_THAT(complaint("[[exemplar]]\nname = 'e'\nimages = ['grey.png', 'clear.png']\n"),
              HasSubstr("the picture of grey.png has 1 channels, and of clear.png 4"));

  // A picture that is filled keeps its channels. Edges that are half transparent may be used.
  const std::string mask = "[[exemplar]]\nname = 'c'\nmask = 'alpha'\nimage = 'clear.png'\n";
  const LoadedRequest plain = load("[fill]\nimage = 'e.png'\nmask = 'hole.png'\n" + mask);
  EXPECT_EQ(plain.exemplars[0].image.channels, 3);
  EXPECT_EQ(plain.exemplars[0].mask.pixels[3], 0);
  EXPECT_EQ(plain.target.known.channels, 3);
  EXPECT_THAT(plain.notes, testing::ElementsAre("clear.png: used without its alpha, as e.png"));
  const LoadedRequest clear = load(
      "[fill]\nimage = 'clear.png'\nmask = 'alpha'\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n");
  EXPECT_EQ(clear.exemplars[0].image.channels, 4);
  EXPECT_EQ(clear.target.known.channels, 4);
  EXPECT_EQ(clear.files[0].channels, 4);
}

TEST_F(DirectionOfConfig, SeamlessMakesABandAnewAndTiles) {
  const Config config = parse("[fill]\nimage = 'e.png'\nseamless = 'x'\nband = 3\n");
  EXPECT_EQ(config.tile, Tile::x);
  const Image mask = load_request(config, 0).target.mask;
  for (int x = 0; x < 32; ++x) EXPECT_EQ(*mask.at(x, 12), x < 3 || x >= 29 ? 1 : 0) << x;
}

TEST_F(DirectionOfConfig, LabelsGetAChannelEachAndTheTextureItsGuidesSize) {
  const Config config = parse(
      "[guide]\nimage = 'both.png'\nweight = 0.5\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
      "guide = 'two.png'\n");
  EXPECT_EQ(config.size, (Size{40, 30}));
  const LoadedRequest loaded = load_request(config, 0);
  ASSERT_EQ(loaded.target.guide.channels, 2);
  EXPECT_EQ(loaded.exemplars[0].guide.at(3, 3)[0], 1);
  EXPECT_EQ(loaded.target.guide.at(3, 3)[1], 1);
  EXPECT_EQ(loaded.target.guide_weight.pixels, std::vector<float>{5.0f});
}

TEST_F(DirectionOfConfig, ValuesOfGuidesHaveVariance1InTheExemplar) {
  const LoadedRequest loaded = load(
      "[guide]\nimage = 'both.png'\nkind = 'values'\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
      "guide = 'two.png'\n");
  ASSERT_EQ(loaded.target.guide.channels, 1);
  EXPECT_NEAR(loaded.exemplars[0].guide.pixels[31] - loaded.exemplars[0].guide.pixels[0], 2, 1e-3);
  EXPECT_NEAR(loaded.target.guide.pixels[0] - loaded.target.guide.pixels[39], 2, 1e-3);
}

TEST_F(DirectionOfConfig, WhatHasNoWeightIsLeftOut) {
  const std::string two = "[[exemplar]]\nname = 'e'\nimages = ['e.png', 'f.png']\n";
  LoadedRequest loaded = load("[mix]\nweights = [0, 2]\n" + two);
  ASSERT_EQ(loaded.exemplars.size(), 1u);
  EXPECT_EQ(loaded.exemplars[0].image.size(), (Size{20, 20}));
  EXPECT_TRUE(loaded.target.weights.empty());
  loaded = load("[mix]\nimages = ['two.png']\n" + two);
  EXPECT_EQ(loaded.target.size, (Size{32, 24}));
  EXPECT_NEAR(loaded.target.weights.at(0, 0)[0], 0.8f, 0.01f);
  EXPECT_NEAR(loaded.target.weights.at(0, 0)[1], 0.2f, 0.01f);
  EXPECT_EQ(load("[mix]\nimages = ['white.png']\n" + two).exemplars.size(), 1u);
}

TEST_F(DirectionOfConfig, TurnsAndScalesAreReadFromPictures) {
  const Image turn = load(
                         "[turn]\nangle = 'white.png'\nangles = [0, 90]\nscale = 'black.png'\n"
                         "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n")
                         .target.turn;
  EXPECT_EQ(turn.at(1, 1)[0], 0.25f);
  EXPECT_EQ(turn.at(1, 1)[1], -1);
}

TEST_F(DirectionOfConfig, SettingsNameWhatDirects) {
  const Config config =
      parse("[fill]\nimage = 'e.png'\nmask = 'hole.png'\nseamless = 'x'\nband = 3\nblend = 2\n");
  FileHashes hashes;
  const Job job = make_plan(config).jobs.front().job;
  const Json before = job_settings(config, job, input_hashes(config, job, hashes));
  EXPECT_EQ(before.at("fill").at("band"), 3);
  EXPECT_EQ(before.at("fill").at("blend"), 2);
  EXPECT_EQ(load_request(config, 0).target.blend, 2);
  write("hole.png", Image(32, 24, 1, 1.0f));
  const Json after = job_settings(config, job, input_hashes(config, job, hashes));
  EXPECT_NE(before, after) << "another mask is another job";
}

TEST_F(DirectionOfConfig, AFilledPictureIsNotTheSameExemplarAsOneNamed) {
  const std::string fill = "[fill]\nimage = 'e.png'\nmask = 'hole.png'\n";
  const Config itself = parse(fill);
  const Config named = parse(fill + "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n");
  FileHashes hashes;
  const Job job{0, 0, 1};
  EXPECT_NE(job_settings(itself, job, input_hashes(itself, job, hashes)),
            job_settings(named, job, input_hashes(named, job, hashes)));
}

TEST_F(DirectionOfConfig, GuidesKeepChannelsThatAreNoAlpha) {
  const Encoding fields{PixelType::float32, "", {"cosine", "sine"}};
  write("field.tif",
        picture({32, 24}, 2, [](int x, int y) { return 0.01f * static_cast<float>(x * y); }),
        fields);
  const LoadedRequest loaded = load(
      "[guide]\nimage = 'field.tif'\nkind = 'values'\n[[exemplar]]\nname = 'e'\nimage = "
      "'e.png'\nguide = 'field.tif'\n");
  EXPECT_EQ(loaded.target.guide.channels, 2);
}

TEST_F(DirectionOfConfig, KnownPixelsOfAPictureFilledOfItselfAreItsOwn) {
  const LoadedRequest loaded = load("[fill]\nimage = 'e.png'\nextend = [3, 2, 0, 0]\n");
  ASSERT_TRUE(loaded.filled_at);
  const Arrangement arrangement = arrangement_of(
      SourceMap(loaded.target.size), {loaded.exemplars, loaded.target}, loaded.filled_at);
  EXPECT_EQ(arrangement.pictures, std::vector<Size>({{32, 24}}));
  EXPECT_EQ(*arrangement.source.at(3, 2), Source(0, 0));
  EXPECT_EQ(*arrangement.source.at(34, 25), Source(31, 23));
}

TEST_F(DirectionOfConfig, MistakesAreOneLineThatNamesBothSides) {
  const std::string e = "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n";
  const std::string two = "[[exemplar]]\nname = 'e'\nimages = ['e.png', 'f.png']\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"[fill]\nimage = 'e.png'\nmask = 'small.png'\n",
       "small.png has 8×8 pixels and e.png 32×24: they must be equal"},
      {"[fill]\nimage = 'e.png'\nmask = 'black.png'\n", "e.png with black.png: the mask is black"},
      {"[fill]\nimage = 'e.png'\nmask = 'white.png'\n", "e.png with white.png"},
      {"[fill]\nimage = 'e.png'\n", "needs 'mask', 'seamless' or 'extend'"},
      {"[fill]\nimage = 'e.png'\nmask = 'alpha'\n", "\"alpha\", and e.png has none"},
      {"[fill]\nimage = 'e.png'\nmask = 'hole'\n", "allowed are a file with its extension"},
      {"size = 64\n[fill]\nimage = 'e.png'\nmask = 'hole.png'\n", "leave 'size' out"},
      {"tile = 'x'\n[fill]\nimage = 'e.png'\nseamless = 'both'\n", "'seamless' of [fill] differ"},
      {"[fill]\nimage = 'e.png'\nextend = [1, 2]\n", "'extend' has 2 numbers"},
      {e + "mask = 'black.png'\n", "black.png is black everywhere: nothing of e.png may be used"},
      {e + "mask = 'small.png'\n", "small.png has 8×8 pixels and e.png 32×24"},
      {e + "guide = 'two.png'\n", "has a 'guide', and there is no [guide]"},
      {"[guide]\nimage = 'both.png'\n" + e, "has no 'guide' for e.png"},
      {"size = 64\n[guide]\nimage = 'both.png'\n" + e + "guide = 'two.png'\n",
       "both.png has 40×30 pixels and the texture 64×64"},
      {"[guide]\nimage = 'both.png'\n" + e + "guide = 'e.png'\n",
       "both.png has 1 channel and that of the exemplar, e.png, 3"},
      {"[guide]\nimage = 'three.png'\n" + e + "guide = 'two.png'\n",
       "three.png has the label (128) at (14, 0), which two.png has not"},
      {"[guide]\nimage = 'both.png'\nkind = 'label'\n" + e, "did you mean 'labels'"},
      {"[mix]\nweights = [1]\n" + two, "1 weights for the 2 pictures of the exemplar 'e'"},
      {"[mix]\nweights = [0, 0]\n" + two, "'weights' are all 0"},
      {"[mix]\n" + two, "needs 'weights' or 'images'"},
      {"[mix]\nimages = ['two.png', 'small.png']\n" + two,
       "small.png has 8×8 pixels and the texture 32×24"},
      {"[mix]\nimages = ['black.png', 'black.png']\n" + two, "at (0, 0) the weights are all 0"},
      {"[mix]\nweights = [1]\n" + e, "the exemplar 'e' is one picture"},
      {"[guide]\nimage = 'two.png'\n" + e + "guide = 'two.png'\nmask = 'left.png'\n",
       "has the label (204) at (16, 0), which two.png has not where it may be used"},
      {"[turn]\nangle = 'two.png'\nscales = [1, 2]\n" + e, "'scales' without a picture"},
      {"coordinates = true\n[turn]\nangle = 'two.png'\n" + e, "no coordinates of them"},
      {"[fill]\nimage = 'e.png'\nmask = 'hole.png'\nband = 4\n", "'band' without 'seamless'"},
      {"coordinates = true\n[fill]\nimage = 'e.png'\nmask = 'hole.png'\n",
       "(blend = 4), and there are no coordinates of blends: allowed with coordinates is blend = "
       "0"},
      {"[fill]\nimage = 'e.png'\nmask = 'hole.png'\nblend = 17\n", "blend"},
      {"[fill]\nimage = 'e.png'\nmask = 'hole.png'\n[[exemplar]]\nname = 'c'\nimage = "
       "'clear.png'\n",
       "clear.png is transparent at (3, 0), and e.png, which is filled, has no alpha"},
      {"pixel_type = 'half'\n[fill]\nimage = 'e.png'\nmask = 'hole.png'\n", "pixel type of its"},
      {"format = 'jpg'\n[fill]\nimage = 'e.png'\nmask = 'hole.png'\n", "a jpg does not keep"},
      {"[fill]\nimage = 'e.png'\nextend = 60000\n", "a side has at most 65536"},
      {"[turn]\n" + e, "needs 'angle' or 'scale'"},
      {"[turn]\nangle = 'two.png'\nangles = [1]\n" + e, "'angles' has 1 number"},
      {"[[exemplar]]\nname = 'e'\nimages = []\n", "'images' is empty"},
      {"[[exemplar]]\nname = 'e'\nimages = ['e.png']\nmask = 'hole.png'\n", "'mask' is of one"},
      {"[[exemplar]]\nname = 'e'\nimages = [3]\n", "images"},
      {"[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { guide = 'two.png' }\n", "taken"},
  };
  for (const auto& [text, message] : cases) {
    const std::string said = complaint(text);
    EXPECT_THAT(said, HasSubstr(message)) << text;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(UsablePart, IsTheLargestRectangleWithoutAMaskedPixel) {
  Exemplar exemplar{Image(10, 8, 1), {}, Image(10, 8, 1, 1.0f)};
  *exemplar.mask.at(3, 4) = 0;
  EXPECT_EQ(usable_part(exemplar), (Rectangle{4, 0, 6, 8}));
  exemplar.mask = {};
  EXPECT_EQ(usable_part(exemplar), (Rectangle{0, 0, 10, 8}));
}

TEST_F(DirectionOfConfig, ArrangementsComeBackFromDisk) {
  for (const int side : {300, 70000}) {
    Arrangement written{SourceMap({4, 3}), {{side, 40}, {8, 8}}};
    *written.source.at(1, 2) = {side - 1, 39, 0};
    *written.source.at(2, 0) = {7, 3, 1};
    const std::string file = write_arrangement(folder_, "seed1", written);
    const Arrangement read = read_arrangement(folder_ / file);
    EXPECT_EQ(read.pictures, written.pictures);
    EXPECT_EQ(read.source.pixels, written.source.pixels);
  }
  EXPECT_THROW(read_arrangement(folder_ / "e.png"), Error);
}

TEST(JoinVisibility, IsHighForAHardEdgeAndLowForNone) {
  Image image(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) *image.at(x, y) = static_cast<float>((x * 7 + y * 5) % 4);
  Image mask(64, 64, 1);
  for (int y = 20; y < 40; ++y)
    for (int x = 20; x < 40; ++x) *mask.at(x, y) = 1;
  EXPECT_LE(join_visibility(image, mask), 1.0001);
  for (std::size_t p = 0; p < mask.pixels.size(); ++p) image.pixels[p] += 20 * mask.pixels[p];
  EXPECT_GT(join_visibility(image, mask), 3);
}

// The documents' table is the program's own.
TEST(Abilities, StandInTheDocuments) {
  EXPECT_THAT(read_text(source_folder() / "docs/directing.md"), HasSubstr(list_abilities()));
}

}  // namespace
}  // namespace gramloom
