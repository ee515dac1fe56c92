// What `check` says of memory holds for a process that does the job and nothing else. Time is not
// tested: tests/bench/estimates.py compares it.
#include <nlohmann/json.hpp>

#include "cli/workspace.h"
#include "jobs/methods.h"

namespace gramloom {
namespace {

using Json = nlohmann::ordered_json;

// As the issue of estimates asks, in both directions.
constexpr double most_wrong = 1.3;

struct EstimateCase {
  std::string name, kind;
  Size exemplar, result;
  int channels;  // 0: there is no exemplar
  std::string params;
};

void expect_about(double found, double estimated) {
  EXPECT_LT(found, most_wrong * estimated) << found / 1e6 << " MB, estimated " << estimated / 1e6;
  EXPECT_GT(found, estimated / most_wrong) << found / 1e6 << " MB, estimated " << estimated / 1e6;
}

class Estimates : public Workspace, public testing::WithParamInterface<EstimateCase> {};

TEST_P(Estimates, OfMemoryAreWhatAProcessTakes) {
  const EstimateCase& test = GetParam();
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has memory of its own";
#endif
  if (test.channels > 0) {
    Image grain(test.exemplar, test.channels);
    Random random(1);
    for (float& value : grain.pixels) value = random.uniform();
    write_image(folder_ / "grain.png", grain, {});
  }
  write_text(
      folder_ / "m.toml",
      fmt::format("size = [{}, {}]\nscores = false\n{}[[method]]\nname = 'm'\nkind = '{}'\n{}\n",
                  test.result.width, test.result.height,
                  test.channels > 0 ? "[[exemplar]]\nname = 'e'\nimage = 'grain.png'\n" : "",
                  test.kind, test.params));
  const Json checked = Json::parse(run({"check", "m.toml", "--json"}).output);
  const Outcome made = run({"run", "m.toml"});
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  expect_about(made.peak_memory, checked["jobs"][0]["memory"]);
}

class InferenceEstimates : public Workspace {};

TEST_F(InferenceEstimates, OfMemoryAreWhatATrainingTakes) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has memory of its own";
#endif
  std::string table = "picture,bend\n";
  Random random(1);
  for (int i = 0; i < 16; ++i) {
    Image picture(96, 80, 3);
    for (float& value : picture.pixels) value = random.uniform();
    write_image(folder_ / fmt::format("p{}.png", i), picture, {});
    table += fmt::format("p{}.png,{}\n", i, i);
  }
  write_text(folder_ / "pairs.csv", table);
  const auto compare = [&](const std::string& keys) {
    write_text(folder_ / "i.toml",
               "[[model]]\nname = 'm'\nkind = 'inference'\npairs = 'pairs.csv'\n" + keys);
    const Json checked = Json::parse(run({"check", "i.toml", "--json"}).output);
    ASSERT_EQ(checked["models"].size(), 1u);
    EXPECT_GT(checked["models"][0]["seconds"], 0);
    EXPECT_EQ(checked["models"][0]["problem"], "");
    const Outcome trained = run({"train", "i.toml", "--output", "o", "--quiet"});
    ASSERT_EQ(trained.exit_code, 0) << trained.errors;
    expect_about(trained.peak_memory, checked["models"][0]["memory"]);
  };
  compare("steps = 2\nbatch = 64\n");                    // maps of the batch
  compare("steps = 1\nbatch = 4\nhidden = [64, 16]\n");  // weights, when they are written
  compare("steps = 1\nbatch = 4\npose = [1]\nto = [9]\nframes = 3\n");
}

TEST_F(InferenceEstimates, SayWhatKeepsATrainingFromBeginning) {
  write_text(folder_ / "i.toml", "[[model]]\nname = 'm'\nkind = 'inference'\npairs = 'few.csv'\n");
  write_text(folder_ / "few.csv", "picture,bend\ne.png,1\ne.png,2\n");
  const Outcome checked = run({"check", "i.toml"});
  EXPECT_EQ(checked.exit_code, 0) << checked.errors;
  EXPECT_THAT(checked.output, testing::ContainsRegex("cannot be trained: .*few.csv: has 2 pairs"));
}

// What makes a method quick without changing what it keeps in memory.
std::string quick(std::string_view kind) {
  if (kind == NeuralParams::kind) return "iterations = [2, 1]\nflow_steps = [1]";
  if (kind == PatchmatchParams::kind) return "iterations = 1";
  if (kind == PyramidParams::kind) return "iterations = 2";
  if (kind == ProceduralParams::kind) return "texture = 'noise'";
  if (kind == GeneratorParams::kind) return "model = 'pebbles'";
  return "";
}

// Every method: where the result counts and where the exemplar does.
std::vector<EstimateCase> cases() {
  std::vector<EstimateCase> all;
  for_each_alternative<Method>([&]<class Params>(std::type_identity<Params>) {
    const std::string kind(Params::kind);
    const auto add = [&](const std::string& name, Size exemplar, Size result, int channels) {
      all.push_back({kind + "_" + name, kind, exemplar, result, channels, quick(kind)});
    };
    if (!Params::abilities.has(Ability::exemplar)) return add("large", {}, {900, 700}, 0);
    add("large", {128, 96}, {900, 700}, 3);
    add("large_exemplar", {700, 500}, {200, 256}, 4);
    // Where writing and showing the result count.
    if (kind == HistogramParams::kind) add("written", {64, 64}, {2400, 2000}, 3);
  });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Cases, Estimates, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace gramloom
