#include "jobs/config.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/text_file.h"
#include "jobs/plan.h"
#include "jobs/settings.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

const std::string noise = "[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'noise'\n";
const std::string exemplar = "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n";
const std::string quilting = "[[method]]\nname = 'q'\nkind = 'quilting'\n";

// A folder with an exemplar beside the config "a.toml".
class ConfigText : public testing::Test {
 protected:
  ConfigText() : folder_(fs::temp_directory_path() / fmt::format("gramloom_config_{}", getpid())) {
    fs::create_directories(folder_);
    write_image(folder_ / "e.png", Image(8, 6, 3, 0.5f), {});
  }
  ~ConfigText() override { fs::remove_all(folder_); }

  Config parse(const std::string& text, const std::vector<std::string>& set = {}) const {
    return parse_config(text, folder_ / "a.toml", set);
  }

  // What the error says, without the folder's name.
  std::string complaint(const std::string& text, const std::vector<std::string>& set = {}) const {
    try {
      parse(text, set);
    } catch (const ConfigError& error) {
      std::string message = error.what();
      const std::string prefix = folder_.string() + "/";
      for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
        message.erase(at, prefix.size());
      return message;
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(ConfigText, EveryExemplarTimesEveryMethodTimesEverySeed) {
  const Config config =
      parse("seeds = [1, 7]\nsize = [64, 32]\ntile = 'x'\n" + noise + exemplar + quilting);
  EXPECT_EQ(config.size, (Size{64, 32}));
  EXPECT_EQ(config.tile, Tile::x);
  EXPECT_EQ(config.exemplars.at(0).image, folder_ / "e.png");
  std::vector<std::string> names;
  for (const auto& job : make_plan(config).jobs) names.push_back(job.name);
  EXPECT_EQ(names, (std::vector<std::string>{"procedural/n/seed1", "procedural/n/seed7",
                                             "e/q/seed1", "e/q/seed7"}));
}

TEST_F(ConfigText, OneNumberIsASquare) {
  EXPECT_EQ(parse("size = 48\n" + noise).size, (Size{48, 48}));
}

TEST_F(ConfigText, WholeNumbersServeAsNumbersButNotTheReverse) {
  EXPECT_EQ(complaint(noise + "gain = 1\n"), "");
  EXPECT_EQ(
      complaint(noise + "octaves = 2.0\n"),
      "a.toml:5:1: 'octaves' is a number with a fraction, allowed is a whole number, 1 to 16");
}

TEST_F(ConfigText, UnknownKeysAreNamedWithTheirPlace) {
  EXPECT_EQ(complaint("sead = [1]\n" + noise),
            "a.toml:1:1: unknown key 'sead' (did you mean 'seeds'?)");
  EXPECT_EQ(complaint(exemplar + quilting + "  patchsize = 8\n"),
            "a.toml:7:3: unknown key 'patchsize' (did you mean 'patch_size'?)");
  EXPECT_EQ(complaint(exemplar + "max_sise = 8\n" + quilting),
            "a.toml:4:1: unknown key 'max_sise' (did you mean 'max_side'?)");
  EXPECT_NE(complaint(noise + "zzzzzzzz = 1\n").find("a.toml:5:1: unknown key 'zzzzzzzz' (allowed"),
            std::string::npos);
}

TEST_F(ConfigText, WrongTypesSayWhatWasFoundAndWhatIsAllowed) {
  EXPECT_EQ(complaint("seeds = 'one'\n" + noise),
            "a.toml:1:1: 'seeds' is a text, allowed is a whole number, 0 to 2147483647, or a list "
            "of these");
  EXPECT_EQ(complaint("seeds = [1, 'one']\n" + noise),
            "a.toml:1:13: 'seeds' is a text, allowed is a whole number, 0 to 2147483647");
  EXPECT_EQ(complaint("tile = true\n" + noise),
            "a.toml:1:1: 'tile' is true or false, allowed is one of none, x, y, both");
  EXPECT_EQ(complaint("size = 1979-05-27\n" + noise),
            "a.toml:1:1: 'size' is a date or time, allowed is [width, height] or one number for "
            "both, each 1 to 65536");
  EXPECT_EQ(complaint("method = 3\n"), "a.toml:1:1: 'method' must be a list of tables: [[method]]");
  EXPECT_EQ(complaint("[method]\nname = 'n'\n"),
            "a.toml:1:2: 'method' must be a list of tables: [[method]]");
}

TEST_F(ConfigText, ValuesOutOfRange) {
  EXPECT_EQ(complaint(noise + "gain = 1.5\n"), "a.toml:5:1: 'gain' = 1.5: allowed are 0 to 1");
  EXPECT_EQ(complaint(noise + "gain = nan\n"), "a.toml:5:1: 'gain' = nan: allowed are 0 to 1");
  EXPECT_EQ(complaint(noise + "gain = inf\n"), "a.toml:5:1: 'gain' = inf: allowed are 0 to 1");
  EXPECT_EQ(complaint("seeds = [1, -2]\n" + noise),
            "a.toml:1:13: 'seeds' = -2: allowed are 0 to 2147483647");
}

TEST_F(ConfigText, SizesThatCannotBe) {
  for (const std::string size : {"0", "-5", "[64, 0]", "[-1, 64]", "65537", "[9000000000, 1]"})
    EXPECT_NE(complaint("size = " + size + "\n" + noise).find(": allowed are 1 to 65536"),
              std::string::npos)
        << size;
  for (const std::string size : {"[]", "[64]", "[1, 2, 3]"})
    EXPECT_NE(complaint("size = " + size + "\n" + noise).find("a.toml:1:1: 'size' has "),
              std::string::npos)
        << size;
  EXPECT_NE(complaint("size = nan\n" + noise), "");
}

TEST_F(ConfigText, UnknownWords) {
  EXPECT_EQ(complaint("tile = 'bth'\n" + noise),
            "a.toml:1:1: unknown tile 'bth' (did you mean 'both'?)");
  EXPECT_EQ(complaint(exemplar + "[[method]]\nname = 'q'\nkind = 'quiltin'\n"),
            "a.toml:6:1: unknown kind 'quiltin' (did you mean 'quilting'?)");
  EXPECT_NE(complaint("[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'xyz'\n")
                .find("a.toml:4:1: unknown texture 'xyz' (allowed are "),
            std::string::npos);
}

TEST_F(ConfigText, MissingKeysAndTables) {
  EXPECT_EQ(complaint("[[method]]\nname = 'n'\n"), "a.toml:1:1: key 'kind' is missing");
  EXPECT_EQ(complaint("[[method]]\nname = 'n'\nkind = 'procedural'\n"),
            "a.toml:1:1: key 'texture' is missing");
  EXPECT_EQ(complaint(exemplar + "[[method]]\nkind = 'quilting'\n"),
            "a.toml:4:1: key 'name' is missing");
  EXPECT_EQ(complaint("[[exemplar]]\nname = 'e'\n" + quilting),
            "a.toml:1:1: key 'image' is missing");
  EXPECT_EQ(complaint(""), "a.toml: there is no [[method]], nor a [[model]] to train");
  EXPECT_EQ(complaint(quilting), "a.toml:1:1: method 'q' needs an [[exemplar]]");
}

TEST_F(ConfigText, NamesThatAreNotFitForFiles) {
  const auto with_name = [&](const std::string& name) {
    return complaint("[[method]]\nkind = 'procedural'\ntexture = 'noise'\nname = " + name + "\n");
  };
  for (const std::string name : {"'a/b'", "'..'", "'.hidden'", "'a\\b'", "\"a\\u0000b\"",
                                 "\"a\\nb\"", "'a*'", "' a'", "''", "5"})
    EXPECT_TRUE(with_name(name).starts_with("a.toml:4:1: ")) << name << ": " << with_name(name);
  EXPECT_EQ(with_name("'brick wall, größer'"), "");
  EXPECT_EQ(with_name("'100% [a] #1 {b} = (c)'"), "");
}

TEST_F(ConfigText, NamesAreAsLongAsTheDiskTakesThem) {
  const auto with_name = [&](const std::string& name) {
    return complaint("[[method]]\nkind = 'procedural'\ntexture = 'noise'\nname = '" + name + "'\n");
  };
  const auto with_map = [&](const std::string& name) {
    return complaint(exemplar + "maps = { '" + name + "' = 'e.png' }\n" + quilting);
  };
  const auto repeated = [](const std::string& letter, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += letter;
    return text;
  };
  EXPECT_EQ(with_name(std::string(255, 'a')), "");
  EXPECT_EQ(with_name(std::string(256, 'a')),
            "a.toml:4:1: name is 256 bytes long, allowed are 255");
  EXPECT_EQ(with_name(repeated("石", 85)), "");
  EXPECT_EQ(with_name(repeated("石", 86)), "a.toml:4:1: name is 258 bytes long, allowed are 255");
  EXPECT_EQ(with_map(std::string(236, 'a')), "");
  EXPECT_EQ(with_map(std::string(237, 'a')), "a.toml:4:1: name is 237 bytes long, allowed are 236");
}

TEST_F(ConfigText, NamesOfOurOwnFilesAreTaken) {
  const auto with_exemplar = [&](const std::string& name) {
    return complaint("[[exemplar]]\nname = '" + name + "'\nimage = 'e.png'\n" + quilting);
  };
  const auto with_method = [&](const std::string& name) {
    return complaint(exemplar + "[[method]]\nname = '" + name + "'\nkind = 'quilting'\n");
  };
  const std::string taken = " is taken by a file of the run's own: choose another";
  for (const std::string name : {"run", "index", "scores", "baseline", "run.json", "Run.JSON",
                                 "index.html", "scores.csv", "SCORES.csv", "baseline.json"})
    EXPECT_EQ(with_exemplar(name), "a.toml:2:1: the name '" + name + "'" + taken);
  for (const std::string name : {"exemplar", "exemplar.png", "Exemplar.tif", "exemplar_height.exr"})
    EXPECT_EQ(with_method(name), "a.toml:5:1: the name '" + name + "'" + taken);
  EXPECT_EQ(with_exemplar("runs") + with_exemplar("exemplar") + with_method("run"), "");
  EXPECT_EQ(complaint(noise + "[[exemplar]]\nname = 'Procedural'\nimage = 'e.png'\n"),
            "a.toml:5:1: the name 'Procedural' is taken by methods without an exemplar");
}

TEST_F(ConfigText, NamesThatDifferInCapitalsAlone) {
  const std::string alone = " differ in capitals alone, which some disks don't tell apart";
  EXPECT_EQ(complaint(exemplar + "[[exemplar]]\nname = 'E'\nimage = 'e.png'\n" + quilting),
            "a.toml:5:1: names 'e' and 'E'" + alone);
  EXPECT_EQ(complaint(exemplar + quilting + "[[method]]\nname = 'Q'\nkind = 'quilting'\n"),
            "a.toml:8:1: names 'q' and 'Q'" + alone);
  EXPECT_EQ(complaint(exemplar + "maps = { h = 'e.png', H = 'e.png' }\n" + quilting),
            "a.toml:4:1: names 'H' and 'h'" + alone);
}

TEST_F(ConfigText, NamesAndSeedsThatAreThereTwice) {
  EXPECT_EQ(complaint(noise + noise), "a.toml:6:1: name 'n' is there twice");
  EXPECT_EQ(complaint(exemplar + exemplar + quilting), "a.toml:5:1: name 'e' is there twice");
  EXPECT_EQ(complaint("seeds = [1, 2, 1]\n" + noise), "a.toml:1:1: 'seeds' has a seed twice");
  EXPECT_EQ(complaint("seeds = []\n" + noise), "a.toml:1:1: 'seeds' is empty");
  EXPECT_EQ(complaint(noise + "[[exemplar]]\nname = 'procedural'\nimage = 'e.png'\n"),
            "a.toml:5:1: the name 'procedural' is taken by methods without an exemplar");
}

TEST_F(ConfigText, FilesThatAreNotThere) {
  EXPECT_EQ(complaint("[[exemplar]]\nname = 'e'\nimage = 'no.png'\n" + quilting),
            "a.toml:3:1: there is no file no.png");
  EXPECT_EQ(complaint("[[exemplar]]\nname = 'e'\nimage = './'\n" + quilting),
            "a.toml:3:1:  is not a file");
}

// "photo" is a file like any other; only `network` may be a name.
TEST_F(ConfigText, ABareWordIsAFileBesideTheConfig) {
  fs::copy_file(folder_ / "e.png", folder_ / "photo");
  const std::string maps = "maps = { height = 'photo' }\n";
  const Config config = parse("[[exemplar]]\nname = 'e'\nimage = 'photo'\n" + maps +
                              "[[method]]\nname = 'm'\nkind = 'neural'\nstart = 'photo'\n"
                              "preset = 'gatys'\nweights = 'photo'\nnetwork = 'vgg19'\n");
  EXPECT_EQ(config.exemplars[0].image, folder_ / "photo");
  EXPECT_EQ(config.exemplars[0].maps.at("height").image, folder_ / "photo");
  const auto& params = std::get<NeuralParams>(config.methods[0].method);
  EXPECT_EQ(params.start, folder_ / "photo");
  EXPECT_EQ(params.weights, folder_ / "photo");
  EXPECT_TRUE(params.network.is_name());
  EXPECT_EQ(method_to_json(params, folder_)["start"], "photo");

  EXPECT_EQ(complaint("[[exemplar]]\nname = 'e'\nimage = 'nothing'\n" + quilting),
            "a.toml:3:1: there is no file nothing");
  EXPECT_EQ(complaint(exemplar + "maps = { height = 'nothing' }\n" + quilting),
            "a.toml:4:10: there is no file nothing");
  for (const std::string key : {"start", "weights"})
    EXPECT_EQ(
        complaint(exemplar + "[[method]]\nname = 'm'\nkind = 'neural'\n" + key + " = 'nothing'\n"),
        "a.toml:7:1: there is no file nothing");
  EXPECT_EQ(complaint(exemplar + "[[method]]\nname = 'm'\nkind = 'neural'\n"
                                 "network = 'nothing.toml'\n"),
            "a.toml:7:1: there is no file nothing.toml");
}

TEST_F(ConfigText, NotToml) {
  EXPECT_TRUE(complaint("seeds = [1, 2\n" + noise).starts_with("a.toml:2:"))
      << complaint("seeds = [1, 2\n");
  EXPECT_TRUE(complaint("size = \xff\xfe\n").starts_with("a.toml:1:"));
  EXPECT_TRUE(complaint("seeds = [1]\nseeds = [2]\n").starts_with("a.toml:2:"));
  EXPECT_NE(complaint(std::string(100000, '[')), "");
}

TEST_F(ConfigText, OverridesTakeThePlaceOfWhatTheConfigSays) {
  const Config config = parse("size = 64\n" + exemplar + quilting + "patch_size = 9\n",
                              {"size=[32, 16]", "seeds=[4,5]", "tile=both", "patch_size=11"});
  EXPECT_EQ(config.size, (Size{32, 16}));
  EXPECT_EQ(config.seeds, (std::vector<int>{4, 5}));
  EXPECT_EQ(config.tile, Tile::both);
  EXPECT_EQ(std::get<QuiltingParams>(config.methods.at(0).method).patch_size, 11);
}

TEST_F(ConfigText, OverridesOfOneMethodOrExemplar) {
  const std::string two = exemplar + quilting + "[[method]]\nname = 'q.2'\nkind = 'quilting'\n";
  const Config config = parse(two, {"method.q.2.patch_size=11", "exemplar.e.max_side=4"});
  EXPECT_EQ(std::get<QuiltingParams>(config.methods.at(0).method).patch_size,
            QuiltingParams{}.patch_size);
  EXPECT_EQ(std::get<QuiltingParams>(config.methods.at(1).method).patch_size, 11);
  EXPECT_EQ(config.exemplars.at(0).max_side, 4);
  const Config odd = parse(exemplar + "[[method]]\nname = 'a=b.c'\nkind = 'quilting'\n",
                           {"method.a=b.c.patch_size=11"});
  EXPECT_EQ(std::get<QuiltingParams>(odd.methods.at(0).method).patch_size, 11);
}

TEST_F(ConfigText, MistakesInOverridesAreFoundLikeThoseInTheFile) {
  const std::string text = exemplar + quilting + "patch_size = 9\n";
  EXPECT_EQ(complaint(text, {"patch_size=-1"}),
            "--set patch_size=-1: 'patch_size' = -1: allowed are 0 to 1024");
  EXPECT_EQ(complaint(text, {"patch_size=big"}),
            "--set patch_size=big: 'patch_size' is a text, allowed is a whole number, 0 to 1024");
  EXPECT_EQ(complaint(text, {"patchsize=8"}),
            "--set patchsize=8: unknown key 'patchsize' (did you mean 'patch_size'?)");
  EXPECT_EQ(complaint(text, {"method.q.patchsize=8"}),
            "--set method.q.patchsize=8: unknown key 'patchsize' (did you mean 'patch_size'?)");
  EXPECT_EQ(complaint(text, {"method.r.patch_size=8"}),
            "--set method.r.patch_size=8: no method is called 'r' (did you mean 'q'?)");
  EXPECT_EQ(complaint(text, {"exemplar.e.image=no.png"}),
            "--set exemplar.e.image=no.png: there is no file no.png");
  EXPECT_EQ(complaint(text, {"patch_size"}), "--set patch_size: must be key=value");
  EXPECT_EQ(complaint(text, {"=3"}), "--set =3: must be key=value");
  EXPECT_EQ(complaint(text, {"size=3\nseeds=[2]"}).substr(0, 10), "--set size");
}

TEST_F(ConfigText, PlanSelectsByPattern) {
  const Config config = parse("seeds = [1, 12]\n" + exemplar + noise + quilting);
  const auto selected = [&](const std::string& only) {
    std::vector<std::string> names;
    for (const auto& job : make_plan(config, only).jobs)
      if (job.selected) names.push_back(job.name);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(selected("e/q"), (Names{"e/q/seed1", "e/q/seed12"}));
  EXPECT_EQ(selected("*/seed1"), (Names{"procedural/n/seed1", "e/q/seed1"}));
  EXPECT_EQ(selected("proc*"), (Names{"procedural/n/seed1", "procedural/n/seed12"}));
  EXPECT_THROW(selected("seed1"), ConfigError);
}

TEST_F(ConfigText, APatternHasNoLettersOfItsOwnBesideStarAndQuestionMark) {
  EXPECT_TRUE(job_matches("[a] #1/q", "[a] #1/q/seed1"));
  EXPECT_FALSE(job_matches("[ab]/q", "a/q/seed1"));
  EXPECT_TRUE(job_matches("{a}!^*/q", "{a}!^/q/seed1"));
  EXPECT_TRUE(job_matches("*石*", "黒石/q/seed1"));
  EXPECT_TRUE(job_matches("?石/?/seed1", "黒石/é/seed1"));
  EXPECT_FALSE(job_matches("??石/q", "黒石/q/seed1"));
  EXPECT_FALSE(job_matches("*??石/q", "黒石/q/seed1"));
  EXPECT_TRUE(job_matches("e*q*1", "e/q/seed1/q/seed1"));
  EXPECT_FALSE(job_matches("\\e/q", "e/q/seed1"));
}

TEST_F(ConfigText, APictureThatCannotBeReadIsAProblemOfItsJobsOnly) {
  write_text(folder_ / "broken.png", "no picture");
  const Config config =
      parse(exemplar + "[[exemplar]]\nname = 'b'\nimage = 'broken.png'\n" + quilting);
  const Plan plan = make_plan(config);
  EXPECT_EQ(plan.jobs.at(0).error, "");
  EXPECT_NE(plan.jobs.at(1).error.find("broken.png"), std::string::npos);
}

TEST_F(ConfigText, MemoryRefusalSaysWhatWouldFit) {
  const Config config = parse("size = [2000, 1000]\n" + noise);
  const Plan plan = make_plan(config);
  const PlannedJob& job = plan.jobs.at(0);
  EXPECT_EQ(memory_refusal(config, plan, job, job.cost.bytes), "");
  const std::string refusal = memory_refusal(config, plan, job, job.cost.bytes / 4);
  int width = 0;
  int height = 0;
  const auto at = refusal.find("size = [");
  ASSERT_NE(at, std::string::npos) << refusal;
  ASSERT_EQ(std::sscanf(refusal.c_str() + at, "size = [%d, %d]", &width, &height), 2);
  const auto cost = [&](Size size) {
    return estimate_method(config.methods[0].method, {.size = size}).bytes;
  };
  EXPECT_LE(cost({width, height}), job.cost.bytes / 4);
  EXPECT_GT(cost({width + 20, height + 10}), job.cost.bytes / 4);
  EXPECT_NE(memory_refusal(config, plan, job, 0).find("no size would fit"), std::string::npos);
}

const std::string patches = exemplar + "[[method]]\nname = 'm'\nkind = 'neural'\n";

NeuralParams params_of(const Config& config) {
  return std::get<NeuralParams>(config.methods.at(0).method);
}

TEST_F(ConfigText, APresetSetsWhatOtherKeysStartFrom) {
  const auto expect = [&](const Config& config, NeuralParams expected) {
    const NeuralParams found = params_of(config);
    EXPECT_EQ(method_to_json(found, folder_), method_to_json(expected, folder_));
  };
  expect(parse(patches), with_preset(Preset::balanced));
  for (const Preset preset : {Preset::fast, Preset::balanced, Preset::quality, Preset::gatys})
    expect(parse(patches + fmt::format("preset = '{}'\n", to_word(preset))), with_preset(preset));
  NeuralParams expected = with_preset(Preset::fast);
  expected.directions = 100;
  expected.patch_sizes = {3, 9};
  // Before or after the preset, in the file or on the command line.
  expect(parse(patches + "directions = 100\npreset = 'fast'\npatch_sizes = [3, 9]\n"), expected);
  expect(parse(patches + "preset = 'fast'\npatch_sizes = [3, 9]\n", {"directions=100"}), expected);
  expect(parse(patches + "directions = 100\npatch_sizes = [3, 9]\npreset = 'quality'\n",
               {"method.m.preset=fast"}),
         expected);
}

TEST_F(ConfigText, AListMayBeOneValue) {
  const NeuralParams params = params_of(
      parse(patches + "iterations = 7\noptimizer = 'lbfgs'\npatch_sizes = 5\nshifts = 2\n"));
  EXPECT_EQ(params.iterations, std::vector{7});
  EXPECT_EQ(params.optimizer, std::vector{Optimizer::lbfgs});
  EXPECT_EQ(params.patch_sizes, std::vector{5});
  EXPECT_EQ(params.shifts, std::vector{2});
  const NeuralParams lists =
      params_of(parse(patches + "iterations = [7, 9]\noptimizer = ['lbfgs', 'adam']\n"));
  EXPECT_EQ(lists.iterations, (std::vector{7, 9}));
  EXPECT_EQ(lists.optimizer, (std::vector{Optimizer::lbfgs, Optimizer::adam}));
  EXPECT_EQ(params_of(parse(patches, {"iterations=[3, 4]"})).iterations, (std::vector{3, 4}));
}

TEST_F(ConfigText, MistakesInPresetsAndLists) {
  EXPECT_EQ(complaint(patches + "preset = 'fst'\n"),
            "a.toml:7:1: unknown preset 'fst' (did you mean 'fast'?)");
  EXPECT_EQ(complaint(patches + "preset = 'zzzzzzz'\n"),
            "a.toml:7:1: unknown preset 'zzzzzzz' (allowed are fast, balanced, quality, gatys)");
  EXPECT_EQ(complaint(patches + "preset = 3\n"),
            "a.toml:7:1: 'preset' is a whole number, allowed is one of fast, balanced, quality, "
            "gatys");
  EXPECT_NE(complaint(patches + "preset = ['fast']\n"), "");
  EXPECT_EQ(complaint(patches + "optimizer = ['adam', 'adm']\n"),
            "a.toml:7:22: unknown optimizer 'adm' (did you mean 'adam'?)");
  EXPECT_EQ(complaint(patches + "patch_sizes = [7, 65]\n"),
            "a.toml:7:19: 'patch_sizes' = 65: allowed are 1 to 64");
  EXPECT_EQ(complaint(patches, {"preset=fst"}),
            "--set preset=fst: unknown preset 'fst' (did you mean 'fast'?)");
}

// What the reader lets pass is an error of the job, before it starts.
TEST_F(ConfigText, ListsThatAreEmptyAndNothingToMatch) {
  const auto error_of = [&](const std::string& text) {
    try {
      return make_plan(parse(patches + text)).jobs.at(0).error;
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(error_of("iterations = []\n").find("iterations is an empty list"), std::string::npos)
      << error_of("iterations = []\n");
  EXPECT_NE(error_of("optimizer = []\n").find("optimizer is an empty list"), std::string::npos);
  EXPECT_NE(error_of("sliced_weight = 0\nspectrum_weight = 0\n").find("there is nothing to match"),
            std::string::npos);
}

TEST_F(ConfigText, AFolderIsAnExemplarForEachPictureInIt) {
  fs::create_directories(folder_ / "set" / "deeper.png");
  for (const char* name : {"wall_2.png", "wall.png", "wall_height.png", "bark_colour.png",
                           "bark_normal.png", "mud_mask.png", ".hidden.png", "B.JPG", "notes.txt"})
    write_text(folder_ / "set" / name, "");
  const Config config =
      parse(quilting + exemplar + "[[exemplar]]\nname = 'all'\nfolder = 'set'\nmax_side = 7\n");
  std::vector<std::string> names;
  for (const ExemplarEntry& entry : config.exemplars) names.push_back(entry.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"e", "B", "bark_colour", "mud_mask", "wall", "wall_2"}));
  EXPECT_EQ(config.exemplars[1].image, folder_ / "set" / "B.JPG");
  EXPECT_EQ(config.exemplars[1].max_side, 7);
  EXPECT_EQ(config.exemplars[0].max_side, std::nullopt);

  const Config other = parse(quilting + "[[exemplar]]\nname = 'all'\nfolder = 'set'\n",
                             {"exemplar.all.folder=" + folder_.string()});
  EXPECT_EQ(other.exemplars.size(), 1u);
  EXPECT_EQ(other.exemplars[0].image.filename(), "e.png");
}

TEST_F(ConfigText, MistakesWithAFolderOfExemplars) {
  const std::string folder = quilting + "[[exemplar]]\nname = 'all'\nfolder = ";
  EXPECT_EQ(complaint(folder + "'gone'\n"), "a.toml:6:1: there is no folder gone");
  EXPECT_EQ(complaint(folder + "'e.png'\n"), "a.toml:6:1: there is no folder e.png");
  EXPECT_EQ(complaint(folder + "7\n"), "a.toml:6:1: 'folder' is a whole number, allowed is a text");
  EXPECT_EQ(complaint(folder + "'.'\nimage = 'e.png'\n"),
            "a.toml:7:1: 'image' is of one picture: leave it or 'folder' out");
  EXPECT_EQ(complaint(folder + "'.'\nmaps = { height = 'e.png' }\n"),
            "a.toml:7:1: 'maps' is of one picture: leave it or 'folder' out");
  EXPECT_EQ(complaint(folder + "'.'\n" + exemplar), "a.toml:8:1: name 'e' is there twice");
  fs::create_directory(folder_ / "empty");
  EXPECT_EQ(complaint(folder + "'empty'\n"), "a.toml:6:1: there is no picture in empty");
  fs::remove_all(folder_ / "empty");
}

}  // namespace
}  // namespace gramloom
