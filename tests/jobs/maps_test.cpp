// Exemplars with maps: read with the picture, made with it, written beside it.
#include <gtest/gtest.h>

#include "jobs/map_file.h"
#include "jobs/plan.h"
#include "jobs/run_folder.h"
#include "jobs/settings.h"
#include "metrics/scores.h"
#include "signal/resize.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

const std::string with_maps =
    "size = [40, 24]\n"
    "[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { height = 'h.png', flow = 'flow.exr' }\n"
    "[[method]]\nname = 'b'\nkind = 'quilting'\npatch_size = 8\n";

// The exemplar with a height (16 bits) and a flow (two half floats) that its colours tell.
class Maps : public Runner {
 protected:
  Maps() { write_maps(1); }

  void write_maps(float scale) const {
    const Image picture = read_image(folder_ / "e.png").image;
    Image height(picture.size(), 1);
    Image flow(picture.size(), 2);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const float* colour = picture.at(x, y);
        *height.at(x, y) = scale * colour[0] * colour[0];
        flow.at(x, y)[0] = 3 - 8 * colour[1];
        flow.at(x, y)[1] = colour[2];
      }
    write_image(folder_ / "h.png", height, {PixelType::uint16, "", {"height"}});
    write_image(folder_ / "flow.exr", flow, {PixelType::half, "", {"u", "v"}});
  }

  // What a map's file holds where a channel of the picture has a value.
  using Relation = std::map<float, std::vector<float>>;
  static Relation relation(const fs::path& picture_file, int channel, const fs::path& map_file) {
    const Image picture = read_image(picture_file).image;
    const Image map = read_image(map_file).image;
    EXPECT_EQ(map.size(), picture.size());
    Relation found;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const std::vector<float> values(map.at(x, y), map.at(x, y) + map.channels);
        const auto [at, fresh] = found.emplace(picture.at(x, y)[channel], values);
        EXPECT_EQ(at->second[0], values[0]) << "not registered at " << x << ", " << y;
      }
    return found;
  }
  static void expect_within(const Relation& result, const Relation& exemplar) {
    EXPECT_GT(result.size(), 50u);
    for (const auto& [value, map] : result) {
      ASSERT_TRUE(exemplar.contains(value)) << value;
      EXPECT_EQ(map[0], exemplar.at(value)[0]) << value;
    }
  }

  std::string refusal(const std::string& text) const {
    try {
      run_text(text);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  // What is said of `maps = …`, without the folder.
  std::string refusal_of_maps(const std::string& maps) const {
    std::string line = refusal("[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = " + maps +
                               "\n[[method]]\nname = 'b'\nkind = 'quilting'\n");
    const std::string folder = folder_.string() + "/";
    for (auto at = line.find(folder); at != std::string::npos; at = line.find(folder))
      line.erase(at, folder.size());
    return line;
  }
};

TEST_F(Maps, StayRegisteredAndKeepTheirFilesEncoding) {
  EXPECT_EQ(run_text(with_maps).done, 1);
  EXPECT_EQ(record("e/b/seed1").files,
            (std::vector<std::string>{"seed1.png", "seed1_flow.exr", "seed1_height.png"}));
  const ImageFile picture = read_image(out("e/b/seed1.png"));
  EXPECT_EQ(picture.image.channels, 3);
  EXPECT_EQ(picture.encoding.pixel_type, PixelType::uint8);
  const ImageFile height = read_image(out("e/b/seed1_height.png"));
  EXPECT_EQ(height.image.channels, 1);
  EXPECT_EQ(height.encoding,
            (Encoding{PixelType::uint16, height.encoding.colour_space, {"height"}}));
  const ImageFile flow = read_image(out("e/b/seed1_flow.exr"));
  EXPECT_EQ(flow.encoding.pixel_type, PixelType::half);
  EXPECT_EQ(flow.encoding.channel_names, (std::vector<std::string>{"u", "v"}));
  EXPECT_EQ(
      Json::parse(height.metadata.at("gramloom:settings"))["exemplar"]["maps"]["height"]["image"],
      "h.png");

  expect_within(relation(out("e/b/seed1.png"), 0, out("e/b/seed1_height.png")),
                relation(folder_ / "e.png", 0, folder_ / "h.png"));
  expect_within(relation(out("e/b/seed1.png"), 1, out("e/b/seed1_flow.exr")),
                relation(folder_ / "e.png", 1, folder_ / "flow.exr"));
}

TEST_F(Maps, TheExemplarsOwnLieBesideItsPicture) {
  run_text(with_maps, {}, {"exemplar.e.max_side=20"});
  EXPECT_EQ(read_image(out("e/exemplar.png")).image.channels, 3);
  const Image expected = fit_longer_side(read_image(folder_ / "h.png").image, 20);
  const Image kept = read_image(out("e/exemplar_height.png")).image;
  ASSERT_EQ(kept.size(), (Size{20, 20}));
  for (std::size_t i = 0; i < kept.pixels.size(); ++i)
    EXPECT_NEAR(kept.pixels[i], expected.pixels[i], 1.0 / 65535);
  EXPECT_EQ(read_image(out("e/exemplar_flow.exr")).image.channels, 2);
}

TEST_F(Maps, ScoresAreThoseOfThePictureAlone) {
  run_text(with_maps);
  const Scores expected = score(read_image(folder_ / "e.png").image,
                                read_image(out("e/b/seed1.png")).image, Tile::none);
  ASSERT_FALSE(expected.values.empty());
  for (const auto& [name, value] : expected.values)
    EXPECT_EQ(record("e/b/seed1").metrics.at(std::string(name)), value) << name;
}

TEST_F(Maps, AChangedMapMeansTheJobAgain) {
  run_text(with_maps);
  EXPECT_EQ(resume(with_maps).skipped, 1);
  write_maps(0.5f);
  EXPECT_EQ(resume(with_maps).done, 1) << "another file";
  EXPECT_EQ(resume(with_maps).skipped, 1);
  EXPECT_EQ(resume(with_maps, {"exemplar.e.maps={}"}).done, 1) << "no maps";
  EXPECT_FALSE(fs::exists(out("e/b/seed1_height.png"))) << "of the result before";
  fs::remove(out("e/b/seed1.json"));
  EXPECT_EQ(resume(with_maps).done, 1);
  fs::remove(out("e/b/seed1_flow.exr"));
  EXPECT_EQ(resume(with_maps).done, 1) << "a map that is gone";
}

TEST_F(Maps, CountInTheEstimateOfMemory) {
  const auto bytes = [&](const std::vector<std::string>& set) {
    return make_plan(parse_config(with_maps, folder_ / "c.toml", set)).jobs.at(0).cost.bytes;
  };
  EXPECT_GT(bytes({}), bytes({"exemplar.e.maps={}"}));
}

TEST_F(Maps, OfAnotherSizeAreRefusedInOneLineThatNamesBoth) {
  write_image(folder_ / "h.png", Image(16, 8, 1), {});
  const std::string line = refusal(with_maps);
  EXPECT_TRUE(line.starts_with((folder_ / "c.toml:2:1: ").string())) << line;
  for (const std::string part : {"h.png has 16×8", "e.png 32×32"})
    EXPECT_NE(line.find(part), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST_F(Maps, MistakesInTheTableAreFoundWithTheirPlace) {
  EXPECT_EQ(refusal_of_maps("{ height = 'no.png' }"), "c.toml:4:10: there is no file no.png");
  EXPECT_EQ(refusal_of_maps("{ height = 3 }"),
            "c.toml:4:10: 'height' is a whole number, allowed is a file, or a table of image, "
            "kind, green");
  EXPECT_EQ(refusal_of_maps("{ height = '' }"), "c.toml:4:1: the map 'height' has no file");
  EXPECT_EQ(refusal_of_maps("{ 'a/b' = 'h.png' }"),
            "c.toml:4:1: name 'a/b' is not fit for a file name");
  EXPECT_EQ(refusal_of_maps("{ '' = 'h.png' }"), "c.toml:4:1: a name is empty");
  EXPECT_EQ(refusal_of_maps("'h.png'"),
            "c.toml:4:1: 'maps' is a text, allowed is a table of files: { name = \"file.png\" }");
}

TEST_F(Maps, OfNormalsMayBeTablesAndMistakesThereHaveTheirPlace) {
  EXPECT_EQ(refusal_of_maps("{ n = { image = 'h.png', kind = 'normals' } }"),
            "c.toml:4:33: unknown kind 'normals' (did you mean 'normal'?)");
  EXPECT_EQ(refusal_of_maps("{ n = { image = 'h.png', gren = 'up' } }"),
            "c.toml:4:33: unknown key 'gren' (did you mean 'green'?)");
  EXPECT_EQ(refusal_of_maps("{ n = { kind = 'normal' } }"), "c.toml:4:14: key 'image' is missing");
  EXPECT_EQ(refusal_of_maps("{ n = { image = 'h.png', kind = 'normal' } }"),
            "c.toml:1:1: the map h.png has 1 channels: kind = \"normal\" needs 3");
  const Config config = parse_config(
      "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
      "maps = { n = { image = 'e.png', kind = 'normal', green = 'down' }, h = 'h.png' }\n"
      "[[method]]\nname = 'b'\nkind = 'quilting'\n",
      folder_ / "c.toml");
  const auto& maps = config.exemplars.at(0).maps;
  EXPECT_EQ(maps.at("n"), (MapFile{folder_ / "e.png", MapKind::normal, GreenAxis::down}));
  EXPECT_EQ(maps.at("h"), (MapFile{folder_ / "h.png", {}, {}}));
  const Json json = config_to_json(config)["exemplar"][0]["maps"];
  EXPECT_EQ(json["h"], "h.png");
  EXPECT_EQ(json["n"], (Json{{"image", "e.png"}, {"kind", "normal"}, {"green", "down"}}));
}

TEST_F(Maps, KindsAreGuessedFromNamesFilesAndValues) {
  Image normals({8, 8}, 3, 0.5f);
  for (std::size_t i = 2; i < normals.pixels.size(); i += 3) normals.pixels[i] = 1;
  const Image grey({8, 8}, 1), colours({8, 8}, 3, 0.3f);
  const auto kind = [](const std::string& map, const std::string& file, const Image& values) {
    return kind_of_map(map, {file, {}, {}}, values);
  };
  EXPECT_EQ(kind("normal", "a.png", colours), MapKind::normal);
  EXPECT_EQ(kind("n", "wall_Normal.png", colours), MapKind::normal);
  EXPECT_EQ(kind("n", "Bricks_NormalDX.jpg", colours), MapKind::normal);
  EXPECT_EQ(kind("n", "a.png", normals), MapKind::normal) << "by its values";
  EXPECT_EQ(kind("n", "a.png", colours), MapKind::colour);
  EXPECT_EQ(kind("albedo", "a.png", normals), MapKind::colour);
  EXPECT_EQ(kind("normal", "a.png", grey), MapKind::scalar) << "it has one channel";
  EXPECT_EQ(kind("height", "normal.png", normals), MapKind::scalar) << "the map's name first";
  EXPECT_EQ(kind("m", "wall_mask.png", grey), MapKind::alpha);
  EXPECT_EQ(kind("opacity", "a.png", grey), MapKind::alpha);
  EXPECT_EQ(kind("orm", "a.png", colours), MapKind::scalar);
  EXPECT_EQ(kind("abnormal", "a.png", grey), MapKind::scalar);
  EXPECT_EQ(kind_of_map("normal", {"a.png", MapKind::scalar, {}}, normals), MapKind::scalar);
}

TEST_F(Maps, WhereGreenPointsIsToldByTheConfigNamesAndTheFileItself) {
  const auto green = [](const MapFile& file, const Metadata& metadata = {}) {
    return green_of_map("n", file, metadata);
  };
  const Metadata down = green_metadata(GreenAxis::down);
  EXPECT_EQ(green({"n.jpg", {}, {}}), GreenAxis::up);
  EXPECT_EQ(green({"Bricks_NormalDX.jpg", {}, {}}), GreenAxis::down);
  EXPECT_EQ(green({"n.png", {}, {}}, down), GreenAxis::down);
  EXPECT_EQ(green({"Bricks_NormalGL.jpg", {}, {}}, down), GreenAxis::up) << "the name first";
  EXPECT_EQ(green({"Bricks_NormalDX.jpg", {}, GreenAxis::up}, down), GreenAxis::up);
}

// Normals of waves, with green up or down, as a map of e.png.
class NormalsOfMaps : public Maps {
 protected:
  NormalsOfMaps() {
    Image normals(read_image(folder_ / "e.png").image.size(), 3);
    for (int y = 0; y < normals.height; ++y)
      for (int x = 0; x < normals.width; ++x) {
        const float slope[] = {0.5f * std::sin(0.4f * static_cast<float>(x)),
                               0.6f * std::sin(0.3f * static_cast<float>(y)) + 0.2f};
        const float length = std::hypot(slope[0], slope[1], 1.0f);
        float* n = normals.at(x, y);
        n[0] = 0.5f + slope[0] / length / 2;
        n[1] = 0.5f + slope[1] / length / 2;
        n[2] = 0.5f + 1 / length / 2;
      }
    write_image(folder_ / "up.png", normals, {PixelType::uint16, "", {}});
    for (std::size_t i = 1; i < normals.pixels.size(); i += 3)
      normals.pixels[i] = 1 - normals.pixels[i];
    write_image(folder_ / "wall_dx.png", normals, {PixelType::uint16, "", {}});
  }
  static std::string config(const std::string& map, const std::string& method) {
    return "size = [40, 24]\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { " + map +
           " }\n[[method]]\nname = 'm'\n" + method;
  }
  Image preview() const { return read_image(out("e/m/seed1_preview.png")).image; }
};

const std::string quilted = "kind = 'quilting'\npatch_size = 8\n";

TEST_F(NormalsOfMaps, RecordAndFilesSayWhereGreenPoints) {
  run_text(config("a = 'wall_dx.png', b = 'up.png', height = 'h.png'", quilted) +
           "[surface]\nnormal = true\ngreen = 'down'\n");
  EXPECT_EQ(record("e/m/seed1").normals,
            (std::map<std::string, GreenAxis>{
                {"a", GreenAxis::down}, {"b", GreenAxis::up}, {"normal", GreenAxis::down}}));
  const auto green = [&](const std::string& file) {
    return green_of_map("n", {"n.png", {}, {}}, read_image(out(file)).metadata);
  };
  for (const std::string file : {"e/m/seed1_a.png", "e/m/seed1_normal.png", "e/exemplar_a.png"})
    EXPECT_EQ(green(file), GreenAxis::down) << file;
  EXPECT_EQ(green("e/m/seed1_b.png"), GreenAxis::up);
}

// The same surface in both conventions is the same surface: to previews, scores and tiling.
TEST_F(NormalsOfMaps, BothConventionsAreOneSurface) {
  const std::string shown =
      "[preview]\nshape = 'plane'\nsize = [48, 32]\nsamples = 1\nrepeat = 1\n";
  for (const std::string& method :
       {quilted, std::string("kind = 'tiling'\nrotation = 90\nwraps = 'both'\n")}) {
    run_text(config("n = 'up.png'", method) + shown);
    const Image up = preview(), up_map = read_image(out("e/m/seed1_n.png")).image;
    const auto scores = record("e/m/seed1").map_metrics->at("n");
    run_text(config("n = 'wall_dx.png'", method) + shown);
    const Image down = preview(), down_map = read_image(out("e/m/seed1_n.png")).image;
    for (std::size_t i = 0; i < up_map.pixels.size(); ++i)
      ASSERT_NEAR(i % 3 == 1 ? 1 - down_map.pixels[i] : down_map.pixels[i], up_map.pixels[i], 1e-4);
    for (std::size_t i = 0; i < up.pixels.size(); ++i)
      ASSERT_NEAR(down.pixels[i], up.pixels[i], 1.01f / 255);
    const auto of_down = record("e/m/seed1").map_metrics->at("n");
    for (const auto& [name, value] : of_down) EXPECT_NEAR(*value, *scores.at(name), 0.01) << name;
    run_text(config("n = { image = 'wall_dx.png', green = 'up' }", method) + shown);
    EXPECT_NE(preview(), down) << "the config's word counts";
  }
}

// Signed normals in floats: after a method that mixes and after one that copies, they are of unit
// length and signed, with green as it was.
TEST_F(Maps, NormalsComeOutAsTheyCameIn) {
  const Image picture = read_image(folder_ / "e.png").image;
  Image normals(picture.size(), 3);
  for (std::size_t i = 0; i < normals.pixels.size(); i += 3) {
    const float x = 0.6f * picture.pixels[i], y = -0.5f * picture.pixels[i + 1];
    const float length = std::sqrt(x * x + y * y + 1);
    normals.pixels[i] = x / length;
    normals.pixels[i + 1] = y / length;
    normals.pixels[i + 2] = 1 / length;
  }
  write_image(folder_ / "n.exr", normals, {PixelType::float32, "", {}});
  const std::string text =
      "size = [40, 24]\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { normal = 'n.exr' }\n"
      "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n"
      "[[method]]\nname = 'p'\nkind = 'pyramid'\n";
  ASSERT_EQ(run_text(text).done, 2);
  for (const std::string job : {"e/q/seed1", "e/p/seed1"}) {
    const Image map = read_image(out(job + "_normal.exr")).image;
    for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
      const float* n = map.pixels.data() + i;
      ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-5) << job;
      ASSERT_GE(n[0], -0.1f) << job;
      ASSERT_LE(n[1], 0.1f) << job << ": green points as it did";
    }
    const auto scores = record(job).map_metrics->at("normal");
    EXPECT_LT(*scores.at("normal_angle"), 10) << job;
    EXPECT_TRUE(scores.contains("normal_bend"));
  }
  run_text(text, {}, {"exemplar.e.max_side=16"});
  const Image small = read_image(out("e/exemplar_normal.exr")).image;
  for (std::size_t i = 0; i < small.pixels.size(); i += 3)
    ASSERT_NEAR(small.pixels[i] * small.pixels[i] + small.pixels[i + 1] * small.pixels[i + 1] +
                    small.pixels[i + 2] * small.pixels[i + 2],
                1, 1e-5);
}

TEST_F(Maps, ThatCannotBeReadFailTheirJobsOnly) {
  write_text(folder_ / "h.png", "no picture");
  EXPECT_EQ(run_text(with_maps).failed, 1);
  EXPECT_NE(record("e/b/seed1").error.find("h.png"), std::string::npos);
}

}  // namespace
}  // namespace gramloom
