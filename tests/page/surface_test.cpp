// The lit ball and wall of a page in a real browser: skipped where there is no Chromium.
#include <cmath>

#include "cli/process.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "page/run_in_browser.h"

namespace gramloom {
namespace {

// Humps in a grid, darker in between, with their height and maps told by it.
void write_humps(const fs::path& folder) {
  Image colour(64, 64, 3), height(64, 64, 1), occlusion(64, 64, 1), roughness(64, 64, 1);
  Image metalness(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const double pi = 3.14159265358979;
      const auto h = static_cast<float>(std::pow(std::sin(x * pi / 16) * std::sin(y * pi / 16), 2));
      *height.at(x, y) = h;
      *occlusion.at(x, y) = 0.2f + 0.8f * h;
      *roughness.at(x, y) = 0.9f - 0.7f * h;
      *metalness.at(x, y) = h > 0.5f ? 1.0f : 0.0f;
      const float values[] = {0.4f + 0.4f * h, 0.4f, 0.3f};
      std::copy(std::begin(values), std::end(values), colour.at(x, y));
    }
  write_image(folder / "e.png", colour, {});
  write_image(folder / "h.png", height, {PixelType::uint16, "", {}});
  write_image(folder / "o.png", occlusion, {});
  write_image(folder / "r.png", roughness, {});
  write_image(folder / "m.png", metalness, {});
}

class SurfacePage : public RunInBrowser {
 protected:
  static void SetUpTestSuite() {
    if (!make_folder("gramloom_surface_page")) return;
    write_humps(folder_);
    write_text(folder_ / "c.toml",
               "size = [64, 64]\ntile = 'both'\nscores = false\n"
               "[[exemplar]]\nname = \"it's 100% #1\"\nimage = 'e.png'\n"
               "maps = { height = 'h.png', occlusion = 'o.png', roughness = 'r.png', "
               "metalness = 'm.png' }\n"
               "[[exemplar]]\nname = 'plain'\nimage = 'e.png'\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 24\n");
    const Outcome outcome = gramloom(folder_, {"run", "c.toml", "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    start_browser();
  }

  // But for the driver's remarks on how long reading pixels takes.
  static std::vector<std::string> problems() {
    std::vector<std::string> found = browser_->problems();
    std::erase_if(found, [](const std::string& text) {
      return text.find("ReadPixels") != std::string::npos;
    });
    return found;
  }
  // Opens the result of an exemplar.
  static void enlarge(const std::string& exemplar, Size window = small_desk, bool dark = false) {
    browser_->open(folder_ / "out/c/index.html", window, dark);
    RunInBrowser::enlarge(exemplar + "/q/seed1");
  }
  // Until it is drawn, and once more after what was just done.
  static void drawn() {
    js("(async () => { for (let i = 0; i < 400 && !(painter?.found && painter.canvas.isConnected); "
       "++i)"
       "  await new Promise((done) => setTimeout(done, 50));"
       " for (let i = 0; i < 3; ++i) await new Promise((done) => requestAnimationFrame(done)); "
       "})()");
  }
  // The mean of the picture's red, green and blue, and by how much it differs from the last one.
  static nlohmann::json look() {
    drawn();
    return js(
        "(() => { const { gl, canvas } = painter;"
        " const now = new Uint8Array(4 * canvas.width * canvas.height);"
        " gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, now);"
        " const last = window.lastLook ?? now; window.lastLook = now; let sum = 0, change = 0;"
        " for (let i = 0; i < now.length; ++i) if (i % 4 < 3)"
        "   { sum += now[i]; change += Math.abs(now[i] - (last[i] ?? 0)); }"
        " const count = now.length * 3 / 4; return { mean: sum / count, change: change / count }; "
        "})()");
  }
  static double change() { return look().at("change"); }
  static void set(const std::string& slider, double value) {
    js(
        fmt::format("(() => {{ const s = document.getElementById('{}'); s.value = {};"
                    " s.dispatchEvent(new Event('input')); }})()",
                    slider, value));
  }
  static void toggle(const std::string& map) {
    js("document.querySelector('[data-map=" + map + "]').click()");
  }
};

TEST_F(SurfacePage, WhatIsDrawnChangesWithTheLightTheTurnAndEachMap) {
  for (const std::string shape : {"o", "w"}) {
    enlarge("it's 100% #1");
    browser_->press(shape);
    EXPECT_GT(look().at("mean"), 8) << "something is seen";
    keep("surface-" + shape);
    browser_->press("ArrowRight");
    EXPECT_GT(change(), 0.5) << "turned";
    js("moveLight(0.8, 0); paintSoon()");
    EXPECT_GT(change(), 0.5) << "another light";
    set("surface-repeat", 4);
    EXPECT_GT(change(), 0.5);
    set("surface-depth", 0.12);
    EXPECT_GT(change(), 0.1);
    EXPECT_LT(change(), 1e-9) << "nothing was done";
    for (const std::string map : {"height", "normal", "occlusion", "roughness", "metalness"}) {
      toggle(map);
      EXPECT_GT(change(), 0.02) << map << " off";
      toggle(map);
      EXPECT_GT(change(), 0.02) << map << " on";
    }
    keep("surface-" + shape + "-repeat");
    EXPECT_THAT(problems(), IsEmpty());
  }
}

TEST_F(SurfacePage, ColoursAloneAreLitToo) {
  enlarge("plain");
  browser_->press("o");
  EXPECT_GT(look().at("mean"), 8);
  EXPECT_EQ(js("document.querySelectorAll('#surface-controls [data-map]').length"), 0);
  EXPECT_EQ(js("document.getElementById('surface-depth')"), nlohmann::json());
  js("moveLight(0.8, 0); paintSoon()");
  EXPECT_GT(change(), 0.5);
  browser_->press("o");
  EXPECT_EQ(js("document.querySelectorAll('#stage canvas').length"), 0) << "the picture again";
  EXPECT_GT(js("document.querySelectorAll('#stage img').length"), 0);
  EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(SurfacePage, DraggingTurnsAndWithShiftMovesTheLight) {
  enlarge("plain");
  browser_->press("o");
  look();
  const auto drag = [](const std::string& shift) {
    js("(() => { const c = painter.canvas; c.setPointerCapture = () => {};"
       " for (const [type, x] of [['pointerdown', 100], ['pointermove', 220], ['pointerup', 220]])"
       "   c.dispatchEvent(new PointerEvent(type, { clientX: x, clientY: 90, shiftKey: " +
       shift + ", bubbles: true })); })()");
  };
  const nlohmann::json before = js("({ ...surface })");
  drag("false");
  EXPECT_GT(change(), 0.3);
  EXPECT_NE(js("surface.yaw"), before.at("yaw"));
  EXPECT_EQ(js("surface.lightYaw"), before.at("lightYaw"));
  drag("true");
  EXPECT_GT(change(), 0.3);
  EXPECT_NE(js("surface.lightYaw"), before.at("lightYaw"));
}

TEST_F(SurfacePage, FitsAPhoneInTheDark) {
  enlarge("it's 100% #1", phone, true);
  browser_->press("w");
  EXPECT_GT(look().at("mean"), 4);
  EXPECT_EQ(js("document.querySelector('dialog').scrollWidth"), 390);
  keep("surface-390-dark");
}

TEST_F(SurfacePage, AnExemplarIsShownToo) {
  enlarge("it's 100% #1");
  browser_->press("o");
  look();
  browser_->press(" ");
  EXPECT_GT(change(), 0.01);
  EXPECT_THAT(js("document.querySelector('#stage .tag').textContent").get<std::string>(),
              HasSubstr("exemplar"));
  EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(SurfacePage, WithoutWebGlThereIsALineThatSaysSo) {
  browser_->open(folder_ / "out/c/index.html", desk);
  js("HTMLCanvasElement.prototype.getContext = () => null");
  js("[...document.querySelectorAll('#rows button')].find((b) => b.dataset.id === 'plain/q/seed1')"
     ".click()");
  browser_->press("o");
  js("new Promise((done) => setTimeout(done, 200))");
  EXPECT_THAT(js("document.getElementById('surface').textContent").get<std::string>(),
              HasSubstr("no WebGL 2"));
}

TEST_F(SurfacePage, ThePageItselfStaysSmall) {
  EXPECT_LT(fs::file_size(folder_ / "out/c/index.html"), 200'000u);
  EXPECT_TRUE(fs::exists(folder_ / "out/c/page/plain/q/seed1.view.js"));
}

}  // namespace
}  // namespace gramloom
