// `gramloom export` from the command line.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <tuple>

#include "cli/workspace.h"
#include "io/json_text.h"
#include "learnt/model_file.h"
#include "learnt/some_generator.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ExportCommand : public Workspace {
 protected:
  ExportCommand() {
    const Image picture = read_image(folder_ / "e.png").image;
    Image map(picture.size(), 1), normals(picture.size(), 3, 0.5f);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        *map.at(x, y) = *picture.at(x, y);
        const float slope = 0.4f * std::sin(0.2f * static_cast<float>(y));
        normals.at(x, y)[1] = 0.5f + slope / 2;
        normals.at(x, y)[2] = 0.5f + std::sqrt(1 - slope * slope) / 2;
      }
    write_image(folder_ / "r.png", map, {});
    write_image(folder_ / "n.png", normals, {});
    write_text(folder_ / "m.toml",
               "size = [40, 24]\ntile = 'both'\n"
               "[[exemplar]]\nname = \"it's 100% #1\"\nimage = 'e.png'\n"
               "maps = { roughness = 'r.png', normal = { image = 'n.png', green = 'down' } }\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n"
               "[[method]]\nname = 'h'\nkind = 'histogram'\n");
    EXPECT_EQ(run({"run", "m.toml", "--quiet"}).exit_code, 0);
  }

  const std::string job_ = "it's 100% #1/q/seed1";
};

TEST_F(ExportCommand, GltfHasTheMapsAndGreenUp) {
  const Outcome outcome =
      run({"export", "out/m", "--target", "gltf", "--only", "*/q", "--output", "x"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "x/" + job_ + ".gltf\n");
  const Json document = parse_json(file("x/" + job_ + ".gltf"));
  EXPECT_EQ(document["materials"][0]["name"], job_);
  for (const Json& image : document["images"])
    EXPECT_TRUE(fs::exists((folder_ / "x" / job_).parent_path() / image["uri"].get<std::string>()));
  const Image before = read_image(folder_ / "out/m" / (job_ + "_normal.png")).image;
  const Image after = read_image(folder_ / "x" / (job_ + "_normal_texture.png")).image;
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 1; i < after.pixels.size(); i += 3)
    ASSERT_NEAR(after.pixels[i], 1 - before.pixels[i], 0.01f);
  const Image packed =
      read_image(folder_ / "x" / (job_ + "_occlusion_roughness_metalness.png")).image;
  const Image roughness = read_image(folder_ / "out/m" / (job_ + "_roughness.png")).image;
  for (std::size_t i = 0; i < roughness.pixels.size(); ++i)
    ASSERT_EQ(packed.pixels[3 * i + 1], roughness.pixels[i]);
}

TEST_F(ExportCommand, GreenIsToldByTheMapsFileToo) {
  fs::copy_file(folder_ / "n.png", folder_ / "n_dx.png");
  write_text(folder_ / "m.toml",
             "size = [40, 24]\ntile = 'both'\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
             "maps = { bend = 'n_dx.png' }\n[[method]]\nname = 'q'\nkind = 'quilting'\n"
             "patch_size = 8\n");
  ASSERT_EQ(run({"run", "m.toml", "--quiet", "--output", "dx"}).exit_code, 0);
  for (const auto& [target, made] :
       {std::pair{"gltf", "e/q/seed1_normal_texture.png"}, {"materialx", "e/q/seed1_normal.png"}}) {
    const Outcome outcome = run({"export", "dx", "--target", target, "--output", target});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const Image before = read_image(folder_ / "dx/e/q/seed1_bend.png").image;
    const Image after = read_image(folder_ / target / made).image;
    for (std::size_t i = 1; i < after.pixels.size(); i += 3)
      ASSERT_NEAR(after.pixels[i], 1 - before.pixels[i], 0.01f) << target;
  }
}

// Programs of others, where the environment says how to start them ("node validate.js").
TEST_F(ExportCommand, ValidatorsAreContent) {
  int validators = 0;
  for (const auto& [target, ending, variable] :
       {std::tuple{"gltf", "gltf", "GRAMLOOM_GLTF_VALIDATOR"},
        {"materialx", "mtlx", "GRAMLOOM_MATERIALX_VALIDATOR"}}) {
    const char* validator = std::getenv(variable);
    if (!validator) continue;
    ++validators;
    ASSERT_EQ(run({"export", "out/m", "--target", target, "--output", target}).exit_code, 0);
    for (const std::string& job : {job_, std::string("it's 100% #1/h/seed1")}) {
      const Outcome outcome =
          shell(folder_, fmt::format("{} \"{}/{}.{}\"", validator, target, job, ending));
      EXPECT_EQ(outcome.exit_code, 0) << target << "\n" << outcome.output << outcome.errors;
    }
  }
  if (validators == 0) GTEST_SKIP() << "the environment names no validator";
}

TEST_F(ExportCommand, MaterialXHasTheRunsOwnFiles) {
  const Outcome outcome = run({"export", "out/m", "--target", "materialx", "--output", "x"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr(job_ + ".mtlx\n"));
  EXPECT_EQ(file("x/" + job_ + ".png"), file("out/m/" + job_ + ".png"));
  EXPECT_EQ(file("x/" + job_ + "_roughness.png"), file("out/m/" + job_ + "_roughness.png"));
  EXPECT_THAT(file("x/" + job_ + ".mtlx"), HasSubstr("value=\"seed1_normal.png\""));
  EXPECT_EQ(read_image(folder_ / "x" / (job_ + "_normal.png")).image.channels, 3);
}

TEST_F(ExportCommand, RefusesInOneLine) {
  fs::create_directories(folder_ / "empty");
  ASSERT_EQ(run({"run", "m.toml", "--quiet", "--output", "lost"}).exit_code, 0);
  for (const auto* name : {"q", "h"})
    fs::remove(folder_ / "lost/it's 100% #1" / name / "seed1.png");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"empty", "--target", "gltf", "--output", "x"}, "empty: there is no run.json"},
      {{"out/m", "--target", "obj", "--output", "x"}, "--target"},
      {{"out/m", "--target", "gltf", "--only", "none", "--output", "x"}, "no job matches"},
      {{"out/m", "--target", "gltf", "--output", "out/m"}, "is the run's own folder"},
      {{"lost", "--target", "gltf", "--output", "x"}, "none of 2 jobs is finished"}};
  for (const auto& [arguments, message] : cases) expect_refused("export", arguments, message);
  EXPECT_FALSE(fs::exists(folder_ / "x"));
}

TEST_F(ExportCommand, FilesOfTheUserStayAndExportsAreReplaced) {
  fs::create_directories(folder_ / "mine");
  write_text(folder_ / "mine/notes.txt", "mine");
  const Outcome refused = run({"export", "out/m", "--target", "gltf", "--output", "mine"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("has files that no export made"));
  for (const auto* target : {"gltf", "materialx", "gltf"})
    EXPECT_EQ(run({"export", "out/m", "--target", target, "--output", "x"}).exit_code, 0);
}

TEST_F(ExportCommand, BothTargetsMayShareAFolder) {
  const auto texts = [&] {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "x"))
      if (entry.is_regular_file()) all[entry.path().string()] = read_text(entry.path());
    return all;
  };
  for (const auto& [first, second] : {std::pair{"gltf", "materialx"}, {"materialx", "gltf"}}) {
    fs::remove_all(folder_ / "x");
    ASSERT_EQ(run({"export", "out/m", "--target", first, "--output", "x"}).exit_code, 0);
    const auto before = texts();
    ASSERT_EQ(run({"export", "out/m", "--target", second, "--output", "x"}).exit_code, 0);
    const auto after = texts();
    EXPECT_GT(after.size(), before.size());
    for (const auto& [name, text] : before) EXPECT_TRUE(after.at(name) == text) << name;
  }
}

TEST_F(ExportCommand, ADamagedPictureDoesNotStopTheOthers) {
  write_text(folder_ / "out/m/it's 100% #1/h/seed1.png", "no picture");
  const Outcome outcome = run({"export", "out/m", "--target", "gltf", "--output", "x"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("it's 100% #1/h/seed1: "));
  EXPECT_EQ(outcome.output, "x/" + job_ + ".gltf\n");
}

class ExportOfModels : public Workspace {
 protected:
  ExportOfModels() {
    write_generator(folder_ / "one.safetensors", some_generator({{4, 8, 1}}));
    write_generator(folder_ / "mix.safetensors", some_generator({{4, 8, 1}}, 3, 2));
  }
};

TEST_F(ExportOfModels, EachTargetIsAFileAndSaysItsName) {
  for (const std::string target : {"c", "glsl", "onnx"}) {
    const Outcome outcome =
        run({"export", "one.safetensors", "--target", target, "--output", "it." + target});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, "it." + target + "\n");
  }
  EXPECT_THAT(file("it.c"), HasSubstr("int it_generate("));
  EXPECT_THAT(file("it.glsl"), HasSubstr("#if PASS == 0"));
  EXPECT_THAT(file("it.onnx"), HasSubstr("noise_0"));
  ASSERT_EQ(run({"export", "one.safetensors", "--target", "c", "--output", "1 2.c"}).exit_code, 0);
  EXPECT_THAT(file("1 2.c"), HasSubstr("int texture_1_2_generate("));
}

TEST_F(ExportOfModels, WeightsMix) {
  const auto exported = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"export", "mix.safetensors", "--target", "c", "--output", "m.c"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).exit_code, 0);
    return file("m.c");
  };
  EXPECT_EQ(exported({}), exported({"--weights", "1,0"}));
  EXPECT_EQ(exported({"--weights", "1,3"}), exported({"--weights", "0.25,0.75"}));
  EXPECT_NE(exported({}), exported({"--weights", "1,3"}));
  EXPECT_THAT(exported({"--weights", "1,3"}), HasSubstr("material 0 0.25, material 1 0.75"));
}

TEST_F(ExportOfModels, RefusesInOneLine) {
  write_text(folder_ / "text.safetensors", "no tensors");
  write_tensors(folder_ / "other.safetensors", {{"a", {{1}, {1.0f}}}});
  write_tensors(folder_ / "pose.safetensors", {{"a", {{1}, {1.0f}}}},
                {{"gramloom", R"({"version":1,"kind":"inference"})"}});
  GeneratorModel lacking = some_generator({{4, 8, 1}});
  lacking.tensors.erase("colours.low");
  write_generator(folder_ / "lacking.safetensors", lacking);
  const std::vector<std::tuple<std::vector<std::string>, int, std::string>> cases{
      {{"nowhere.safetensors", "--target", "c", "--output", "x"}, 2, "nowhere.safetensors"},
      {{"nothing", "--target", "c", "--output", "x"}, 2, "unknown model 'nothing'"},
      {{"text.safetensors", "--target", "c", "--output", "x"}, 2, "text.safetensors"},
      {{"other.safetensors", "--target", "glsl", "--output", "x"}, 2, "no model that gramloom"},
      {{"pose.safetensors", "--target", "onnx", "--output", "x"}, 2, "of kind 'inference'"},
      {{"lacking.safetensors", "--target", "c", "--output", "x"}, 2, "lacks the tensor"},
      {{"one.safetensors", "--target", "gltf", "--output", "x"}, 2, "c, glsl, onnx"},
      {{"one.safetensors", "--target", "obj", "--output", "x"}, 2, "--target"},
      {{".", "--target", "c", "--output", "x"}, 2, "is a folder"},
      {{"one.safetensors", "--target", "c", "--only", "a", "--output", "x"}, 2, "--only"},
      {{"mix.safetensors", "--target", "c", "--weights", "1,2,3", "--output", "x"}, 2, "weights"},
      {{"mix.safetensors", "--target", "c", "--weights", "0,0", "--output", "x"}, 2, "weights"},
      {{"mix.safetensors", "--target", "c", "--weights", "-1,2", "--output", "x"}, 2, "weights"},
      {{"one.safetensors", "--target", "c", "--output", "one.safetensors"}, 2, "the model itself"},
      {{"one.safetensors", "--target", "c", "--output", "no/x"}, 2, "no/x"}};
  for (const auto& [arguments, code, message] : cases)
    expect_refused("export", arguments, message, code);
  EXPECT_FALSE(fs::exists(folder_ / "x"));
  EXPECT_EQ(run({"export", "one.safetensors", "--target", "c", "--output", "y.c"}).exit_code, 0)
      << "the model is as it was";
}

}  // namespace
}  // namespace gramloom
