// A trained generator at work in a page, in a real browser: skipped where there is no Chromium.
#include <cstdlib>

#include "cli/process.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "learnt/some_generator.h"
#include "page/run_in_browser.h"

namespace gramloom {
namespace {

const std::string config =
    "seeds = [1, 2]\nsize = [45, 38]\nscores = false\n"
    "[[method]]\nname = 'one'\nkind = 'generator'\nmodel = 'one.safetensors'\n"
    "[[method]]\nname = 'mix'\nkind = 'generator'\nmodel = 'mix.safetensors'\n"
    "weights = [1, 3]\n"
    "[[method]]\nname = 'large'\nkind = 'generator'\nmodel = 'large.safetensors'\n"
    "[[method]]\nname = 'stone'\nkind = 'procedural'\ntexture = 'pebbles'\n";

class LivePage : public RunInBrowser {
 protected:
  static void SetUpTestSuite() {
    if (!make_folder("gramloom_live_page")) return;
    // 20 channels are five layers of a texture: two passes.
    write_generator(folder_ / "one.safetensors",
                    some_generator({{8, 20, 2}, {4, 8, 3}, {4, 6, 1}}));
    write_generator(folder_ / "mix.safetensors", some_generator({{4, 8, 2}, {4, 8, 2}}, 5, 2));
    write_generator(folder_ / "large.safetensors", some_generator({{4, 128, 3}}));
    write_text(folder_ / "c.toml", config);
    for (const std::string tile : {"none", "both"}) {
      const Outcome outcome = gramloom(
          folder_, {"run", "c.toml", "--quiet", "--set", "tile=" + tile, "--output", tile});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    }
    start_browser();
  }

  static void enlarge(const std::string& run, const std::string& job) {
    browser_->open(folder_ / run / "index.html", desk);
    RunInBrowser::enlarge(job);
    browser_->press("l");
  }
  // Waits until the picture of a seed is there.
  static void made(int seed) {
    js(
        fmt::format("(async () => {{ for (let i = 0; i < 1200 && !(live?.seed === {} && "
                    "live.canvas.isConnected) && !/cannot/.test(byId('live')?.textContent); ++i)"
                    "  await new Promise((done) => setTimeout(done, 50)); }})()",
                    seed));
    ASSERT_EQ(js("byId('live').textContent"), "");
  }
  // By how many levels of 8 bits the canvas differs from the file, at most.
  static int difference(const fs::path& file) {
    const Image image = read_image(file).image;
    const nlohmann::json pixels =
        js("(() => { const { gl, canvas } = live;"
           " const bytes = new Uint8Array(4 * canvas.width * canvas.height);"
           " gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);"
           " return [canvas.width, canvas.height, ...bytes]; })()");
    if (pixels[0] != image.width || pixels[1] != image.height) return 1000;
    int most = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < 3; ++c) {
          // The canvas's rows begin at the bottom.
          const int i = 2 + 4 * ((image.height - 1 - y) * image.width + x) + c;
          const auto byte = static_cast<int>(std::lround(image.at(x, y)[c] * 255));
          most = std::max(most, std::abs(pixels[static_cast<std::size_t>(i)].get<int>() - byte));
        }
    return most;
  }
  static std::vector<std::string> problems() {
    std::vector<std::string> found = browser_->problems();
    std::erase_if(found, [](const std::string& text) {
      return text.find("ReadPixels") != std::string::npos;
    });
    return found;
  }
};

TEST_F(LivePage, MakesTheFilesPicture) {
  for (const std::string run : {"none", "both"})
    for (const std::string method : {"one", "mix"}) {
      const std::string job = "procedural/" + method + "/seed";
      enlarge(run, job + "1");
      made(1);
      EXPECT_LE(difference(folder_ / run / (job + "1.png")), 1) << run << " " << job;
      keep("live-" + run + "-" + method);
      js("byId('live-seed').click()");
      made(2);
      EXPECT_LE(difference(folder_ / run / (job + "2.png")), 1) << run << " " << job;
      EXPECT_THAT(js("byId('live-tag').textContent").get<std::string>(), HasSubstr("seed 2"));
      EXPECT_THAT(problems(), IsEmpty());
    }
}

TEST_F(LivePage, ShadersThatAreTooLongAreLeftOut) {
  browser_->open(folder_ / "none/index.html", desk);
  EXPECT_EQ(js("data.jobs.filter((job) => job.live).map((job) => job.method)"),
            (nlohmann::json{"one", "one", "mix", "mix"}));
}

TEST_F(LivePage, OnlyGeneratorsAreLiveAndTheViewGoesOnBesideOthers) {
  enlarge("none", "procedural/stone/seed1");
  EXPECT_EQ(js("byId('live')"), nlohmann::json());
  EXPECT_EQ(js("document.querySelectorAll('#stage img').length > 0"), true);
  EXPECT_EQ(js("[...document.querySelectorAll('.segments button')].some((b) => b.textContent === "
               "'live')"),
            false);
  browser_->press("ArrowLeft");
  browser_->press("ArrowLeft");
  browser_->press("ArrowLeft");
  made(2);
  browser_->press("l");
  EXPECT_EQ(js("byId('live')"), nlohmann::json()) << "the picture again";
  EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(LivePage, WithoutFloatTexturesThereIsALineThatSaysSo) {
  browser_->open(folder_ / "none/index.html", desk);
  js("WebGL2RenderingContext.prototype.getExtension = () => null");
  RunInBrowser::enlarge("procedural/one/seed1");
  browser_->press("l");
  js("new Promise((done) => setTimeout(done, 500))");
  EXPECT_THAT(js("byId('live').textContent").get<std::string>(), HasSubstr("no float textures"));
}

TEST_F(LivePage, TheScriptOutlivesTheModelButIsNotMadeOfAnother) {
  const fs::path page = folder_ / "none/page";
  const auto scripts = [&] {
    return std::ranges::count_if(fs::directory_iterator(page), [](const auto& entry) {
      return entry.path().string().ends_with(".live.js");
    });
  };
  EXPECT_EQ(scripts(), 2) << "seeds share one";
  fs::rename(folder_ / "one.safetensors", folder_ / "away");
  ASSERT_EQ(gramloom(folder_, {"report", "none"}).exit_code, 0);
  enlarge("none", "procedural/one/seed1");
  made(1);
  write_generator(folder_ / "one.safetensors", some_generator({{4, 8, 1}}));
  for (const auto& entry : fs::directory_iterator(page))
    if (entry.path().string().ends_with(".live.js")) fs::remove(entry);
  ASSERT_EQ(gramloom(folder_, {"report", "none"}).exit_code, 0);
  EXPECT_EQ(scripts(), 1) << "of the model that is still there";
  fs::rename(folder_ / "away", folder_ / "one.safetensors");
  ASSERT_EQ(gramloom(folder_, {"report", "none"}).exit_code, 0);
  EXPECT_EQ(scripts(), 2);
}

}  // namespace
}  // namespace gramloom
