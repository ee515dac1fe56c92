#include "report/page_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/hash.h"
#include "io/image_file.h"
#include "io/temp_folder.h"
#include "io/text_file.h"
#include "metrics/map_scores.h"
#include "report/page.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A folder as a run leaves it, with as little in it as a test needs.
class PageData : public TempFolder {
 protected:
  void write(const std::string& file, const Json& json) const {
    fs::create_directories((path() / file).parent_path());
    write_text(path() / file, json.dump());
  }
  void write_run(const Json& jobs, const Json& more = Json::object()) const {
    Json run{{"config", "configs/walls.toml"}, {"jobs", jobs}};
    run.update(more);
    write("run.json", run);
  }
  void write_job(const std::string& name, const Json& more = Json::object()) const {
    const fs::path parts(name);
    Json record{{"exemplar", parts.begin()->string()},
                {"method", std::next(parts.begin())->string()},
                {"kind", "quilting"},
                {"seed", 1},
                {"width", 4},
                {"height", 3},
                {"status", "done"},
                {"error", ""},
                {"seconds", 0.5},
                {"peak_memory_mb", 10},
                {"settings", Json::object()},
                {"metrics", {{"stsim2", 0.9}}},
                {"files", {parts.filename().string() + ".png"}}};
    record.update(more);
    write(name + ".json", record);
    write_image(path() / (name + ".png"), Image(4, 3, 3, 0.5f), {});
  }
  Json read() const { return page_data(read_run(path())); }
  std::string error() const {
    try {
      write_page(path());
    } catch (const Error& thrown) {
      return thrown.what();
    }
    return "";
  }
};

TEST_F(PageData, HoldsWhatTheFolderHolds) {
  write_run(
      {{"brick/q/seed1", {{"status", "done"}}}},
      {{"set", {"size=4"}},
       {"settings", {{"exemplar", {{{"name", "brick"}, {"image", "../data/brick.png"}}}}}},
       {"diversity", {{{"exemplar", "brick"}, {"method", "q"}, {"seeds", {1}}, {"value", 0.5}}}}});
  write_job("brick/q/seed1",
            {{"files", {"seed1.png", "seed1_height.png"}}, {"copy_map", "brick/q/map.png"}});
  for (const std::string name :
       {"brick/q/seed1_height.png", "brick/q/map.png", "brick/exemplar.png"})
    write_image(path() / name, Image(5, 3, 3), {});
  write_text(path() / "brick/q/seed1.csv", "step,evaluations,seconds,loss\n1,2,0.5,9\n2,4,1.5,3\n");
  const Json data = read();
  EXPECT_EQ(data["title"], "walls");
  EXPECT_EQ(data["run"]["set"], Json({"size=4"}));
  EXPECT_EQ(data["methods"], Json({"q"}));
  EXPECT_EQ(data["diversity"][0]["value"], 0.5);
  EXPECT_EQ(data["trouble"], Json::array());
  EXPECT_EQ(data["exemplars"][0]["image"], "../data/brick.png");
  EXPECT_EQ(data["exemplars"][0]["picture"],
            (Json{{"file", "brick/exemplar.png"}, {"width", 5}, {"height", 3}}));
  const Json& job = data["jobs"][0];
  EXPECT_EQ(job["name"], "brick/q/seed1");
  EXPECT_EQ(job["pictures"][0], (Json{{"label", "picture"}, {"file", "brick/q/seed1.png"}}));
  EXPECT_EQ(job["pictures"][1], (Json{{"label", "height"}, {"file", "brick/q/seed1_height.png"}}));
  EXPECT_EQ(job["copy_map"], "brick/q/map.png");
  EXPECT_EQ(job["metrics"]["stsim2"], 0.9);
  EXPECT_EQ(job["trace"]["loss"], Json({9.0, 3.0}));
}

TEST_F(PageData, HoldsTheMapsOfAnExemplar) {
  write_run({{"brick/q/seed1", {{"status", "done"}}}},
            {{"settings",
              {{"exemplar",
                {{{"name", "brick"},
                  {"image", "brick.png"},
                  {"maps", {{"height", "h.exr"}, {"gone", "g.png"}}}}}}}}});
  write_job("brick/q/seed1", {{"files", {"seed1.png", "seed1_height.exr"}}});
  write_image(path() / "brick/exemplar.png", Image(5, 3, 3), {});
  for (const std::string name : {"brick/exemplar_height.exr", "brick/q/seed1_height.exr"})
    write_image(path() / name, Image(5, 3, 1, 40.0f), {PixelType::half, "", {}});
  const Json data = read();
  EXPECT_EQ(data["exemplars"][0]["maps"], (Json{{"height", "h.exr"}, {"gone", "g.png"}}));
  EXPECT_EQ(data["exemplars"][0]["map_pictures"],
            Json({{{"label", "height"}, {"file", "page/brick/exemplar_height.exr.png"}}}));
  EXPECT_EQ(data["jobs"][0]["pictures"][1],
            (Json{{"label", "height"}, {"file", "page/brick/q/seed1_height.exr.png"}}));
  const float white = read_image(path() / "page/brick/q/seed1_height.exr.png").image.pixels[0];
  EXPECT_EQ(white, 1.0f) << "its own range, not the picture's";
}

// What the lit view of a job or exemplar is told of green.
TEST_F(PageData, NormalsPointAsTheRecordSays) {
  write_run(
      {{"brick/q/seed1", {{"status", "done"}}}},
      {{"settings",
        {{"exemplar", {{{"name", "brick"}, {"image", "b.png"}, {"maps", {{"n", "b_dx.png"}}}}}}}}});
  write_job("brick/q/seed1");
  for (const std::string name : {"brick/exemplar", "brick/exemplar_n", "brick/q/seed1_n"})
    write_image(path() / (name + ".png"), Image(4, 3, 3, 0.5f), {});
  const auto green = [&](const Json& shown) {
    const std::string text = read_text(path() / shown["view"].get<std::string>());
    EXPECT_THAT(text, HasSubstr("\"normal\":"));
    return text.find("\"green\":\"down\"") != std::string::npos ? "down" : "up";
  };
  for (const std::string word : {"down", "up"}) {
    fs::remove_all(path() / "page");
    JobRecord record;
    record.exemplar = "brick";
    record.method = "q";
    record.status = Status::done;
    record.settings = Json::object();
    record.files = {"seed1.png", "seed1_n.png"};
    record.normals = {{"n", word == "down" ? GreenAxis::down : GreenAxis::up}};
    write_record(path() / "brick/q/seed1.json", record);
    const Json data = read();
    EXPECT_EQ(green(data["jobs"][0]), word);
    EXPECT_EQ(green(data["exemplars"][0]), word);
  }
  fs::remove_all(path() / "page");
  write_job("brick/q/seed1",
            {{"files", {"seed1.png", "seed1_n.png"}},
             {"settings",
              {{"exemplar", {{"maps", {{"n", {{"image", "b_dx.png"}, {"kind", "normal"}}}}}}}}}});
  const Json old = read();
  EXPECT_EQ(green(old["jobs"][0]), "down") << "a record of before: as its settings say";
  EXPECT_EQ(green(old["exemplars"][0]), "down");
}

TEST_F(PageData, HasEveryMetricWithItsDirection) {
  write_run(Json::object());
  const Json list = read()["metrics"];
  ASSERT_EQ(list.size(), metrics().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i]["name"], metrics()[i].name);
    EXPECT_EQ(list[i]["higher_is_better"], metrics()[i].higher_is_better);
  }
}

TEST_F(PageData, MapsHaveScoresOfTheirOwn) {
  const Json scores{{"normal", {{"normal_angle", 2.5}, {"normal_bend", nullptr}}}};
  write_job("e/m/seed1", {{"map_metrics", scores}});
  write_run({{"e/m/seed1", {{"status", "done"}}}});
  const Json data = read();
  EXPECT_EQ(data["map_metrics"].size(), map_metrics().size());
  EXPECT_EQ(data["map_metrics"][0]["name"], "normal_angle");
  ASSERT_EQ(data["jobs"].size(), 1u);
  EXPECT_EQ(data["jobs"][0]["map_metrics"], scores);
}

TEST_F(PageData, JobsThatDidNotComeOutHaveTheirPlace) {
  write_run({{"e/waiting/seed1", {{"status", "waiting"}}},
             {"e/failed/seed1", {{"status", "failed"}}},
             {"e/garbage/seed1", {{"status", "done"}}},
             {"e/half/seed1", {{"status", "done"}}},
             {"e/lost/seed1", {{"status", "done"}}}});
  write_job("e/failed/seed1", {{"status", "failed"}, {"error", "no"}, {"files", Json::array()}});
  write_job("e/garbage/seed1");
  write_text(path() / "e/garbage/seed1.json", "{\"exemplar\": ");
  write_job("e/half/seed1", {{"method", 3}});
  write_job("e/lost/seed1");
  fs::remove(path() / "e/lost/seed1.png");
  const Json data = read();
  EXPECT_EQ(data["jobs"][0]["status"], "waiting");
  EXPECT_EQ(data["jobs"][1]["error"], "no");
  for (const std::size_t broken : {2u, 3u}) {
    EXPECT_EQ(data["jobs"][broken]["status"], "failed");
    EXPECT_NE(data["jobs"][broken]["error"], "");
  }
  EXPECT_EQ(data["jobs"][4]["pictures"], Json::array());
  ASSERT_EQ(data["trouble"].size(), 1u);
  EXPECT_THAT(data["trouble"][0].get<std::string>(), HasSubstr("e/lost/seed1.png"));
  EXPECT_EQ(data["exemplars"][0]["picture"], Json());
  const WrittenPage page = write_page(path());
  EXPECT_TRUE(fs::exists(page.file)) << "a page all the same";
  EXPECT_THAT(page.trouble, testing::ElementsAre(HasSubstr("e/lost/seed1.png")));
}

TEST_F(PageData, ATrainingShowsItsSamplesInOrderAndItsLosses) {
  write_run(Json::object());
  EXPECT_EQ(read().at("trainings"), Json::array());
  const fs::path models = path() / "models";
  fs::create_directories(models);
  write_text(models / "walls_small.safetensors", "not looked into");
  write_text(models / "walls_small.csv",
             "step,evaluations,seconds,loss\n1,1,0.5,3\n2,2,1,2\n3,3,1.5,1\n");
  for (const char* name : {"walls_small_held_out.png", "walls_small_001000.png",
                           "walls_small_000200.png", "walls_small_notes.png"})
    write_image(models / name, Image(5, 4, 3, 0.5f), {});
  const Json training = read().at("trainings").at(0);
  EXPECT_EQ(training.at("name"), "walls_small");
  EXPECT_EQ(training.at("file"), "models/walls_small.safetensors");
  EXPECT_EQ(training.at("trace").at("loss"), Json({3, 2, 1}));
  EXPECT_EQ(training.at("trace_file"), "models/walls_small.csv");
  ASSERT_EQ(training.at("samples").size(), 3u);
  EXPECT_EQ(training.at("samples").at(0).at("step"), 200);
  EXPECT_EQ(training.at("samples").at(1).at("file"), "models/walls_small_001000.png");
  EXPECT_EQ(training.at("samples").at(2).at("step"), nullptr);
  EXPECT_EQ(training.at("samples").at(2).at("width"), 5);
}

TEST_F(PageData, TheCommandOfAJobIsThatOfItsOwnRecord) {
  write_run({{"e/q/seed1", {{"status", "done"}}}, {"e/q/seed2", {{"status", "done"}}}},
            {{"config_text", "size = 4"}, {"set", {"size=9"}}, {"machine", {{"threads", 8}}}});
  write_job("e/q/seed1", {{"config", "old.toml"},
                          {"config_hash", hash_of("size = 3")},
                          {"set", {"size=5"}},
                          {"machine", {{"threads", 3}}}});
  write_job("e/q/seed2");
  const Json data = read();
  EXPECT_EQ(data["jobs"][0]["origin"],
            (Json{{"config", "old.toml"}, {"set", {"size=5"}}, {"threads", 3}, {"edited", true}}));
  EXPECT_EQ(data["jobs"][1]["origin"], (Json{{"config", "configs/walls.toml"},
                                             {"set", {"size=9"}},
                                             {"threads", 8},
                                             {"edited", false}}))
      << "a record of before: what the run says";
}

TEST_F(PageData, TheRecordsHoldWhereARunWasKilledBeforeItSaidSo) {
  write_run(
      {{"e/q/seed1", {{"status", "waiting"}}}},
      {{"diversity", {{{"exemplar", "e"}, {"method", "q"}, {"seeds", {1, 2}}, {"value", 0.5}}}}});
  write_job("e/q/seed1");
  EXPECT_EQ(read()["jobs"][0]["status"], "done");
  EXPECT_EQ(read()["diversity"], Json::array()) << "of textures that are no longer there";
}

TEST_F(PageData, NoNameLeadsOutOfTheFolder) {
  write_image(path() / "secret.png", Image(2, 2, 3), {});
  write_run({{"e/q/seed1", {{"status", "done"}}}});
  write_job("e/q/seed1", {{"files", {"../../secret.png"}}, {"copy_map", "../secret.png"}});
  const Json data = read();
  EXPECT_EQ(data["jobs"][0]["pictures"], Json::array());
  EXPECT_EQ(data["jobs"][0]["copy_map"], Json());
  for (const std::string name : {"../q/seed1", "/etc/q/seed1", "e/q", "e/q/x", "e/q/seed"}) {
    write_run({{name, {{"status", "done"}}}});
    EXPECT_NE(error(), "") << name;
  }
}

TEST_F(PageData, AFolderOfNoRunIsAnError) {
  EXPECT_THAT(error(), HasSubstr("there is no run.json"));
  for (const std::string text : {"", "[]", "{}", "{\"jobs\": 3}", "nonsense"}) {
    write_text(path() / "run.json", text);
    EXPECT_THAT(error(), HasSubstr("run.json")) << text;
  }
  EXPECT_FALSE(fs::exists(path() / "index.html"));
}

TEST_F(PageData, ALongTraceIsThinnedOutAndKeepsItsEnds) {
  Trace trace;
  for (int i = 1; i <= 1000; ++i) trace.rows.push_back({i, i, i * 0.5, 1.0 / i, {}});
  const Json thin = thin_trace(trace, 100);
  ASSERT_EQ(thin["steps"].size(), 100u);
  EXPECT_EQ(thin["steps"].front(), 1);
  EXPECT_EQ(thin["steps"].back(), 1000);
  EXPECT_EQ(thin["seconds"].back(), 500.0);
  EXPECT_EQ(thin_trace(trace, 2000)["loss"].size(), 1000u);
  trace.rows.resize(1);
  EXPECT_EQ(thin_trace(trace, 100)["steps"], Json({1}));
}

// The data's text between its script tags.
std::string data_block(const std::string& html) {
  const std::string begin = "id=\"data\">";
  const auto start = html.find(begin) + begin.size();
  return html.substr(start, html.find("</script>", start) - start);
}

TEST(PageHtml, DataStaysDataWhateverItHolds) {
  for (const std::string text :
       {"</script><script>alert(1)</script>", "<!-- <script>", "/*data*/ \" ' \\ \n \t &amp;",
        "\xE2\x80\xA8 \xE7\xA0\x82", "]]>", "/*scripts*/"}) {
    const Json data{{text, {text, nullptr, 1.5}}};
    const std::string block = data_block(page_html(data));
    EXPECT_EQ(block.find('<'), std::string::npos);
    EXPECT_EQ(Json::parse(block), data) << text;
  }
  EXPECT_NO_THROW(page_html({{"path", "bytes \xFF that are no UTF-8"}}));
}

TEST(PageHtml, NeedsNoNetworkAndNoOtherFile) {
  const std::string html = page_html(Json::object());
  EXPECT_EQ(html.find("/*style*/"), std::string::npos);
  EXPECT_EQ(html.find("/*scripts*/"), std::string::npos);
  EXPECT_EQ(html.find("<link rel=\"stylesheet"), std::string::npos);
  EXPECT_EQ(html.find("<script src"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
}

}  // namespace
}  // namespace gramloom
