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
  const double estimated = checked["jobs"][0]["memory"];
  EXPECT_LT(made.peak_memory, most_wrong * estimated)
      << made.peak_memory / 1e6 << " MB, estimated " << estimated / 1e6;
  EXPECT_GT(made.peak_memory, estimated / most_wrong)
      << made.peak_memory / 1e6 << " MB, estimated " << estimated / 1e6;
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
  });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Cases, Estimates, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace gramloom
