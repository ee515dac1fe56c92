// The page of a real run in a real browser: skipped where there is no Chromium.
#include "cli/process.h"
#include "core/random.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "page/run_in_browser.h"

namespace gramloom {
namespace {

// Names that trip over quoting, addresses, HTML and JSON.
const std::string odd_name = "it's 100% #1 & ünï 砂";
const std::string patch_job = odd_name + "/patch 'n' match/seed1";
const std::string broken_path = "no</script><img src=x onerror=alert(1)>.png";

void write_exemplar(const fs::path& file, std::uint64_t seed, Encoding encoding = {}) {
  Image image(48, 40, 3);
  Random random(seed);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = 0.2f + 0.3f * static_cast<float>((x / 6 + y / 5) % 2) +
                            0.05f * static_cast<float>(c) + 0.3f * random.uniform();
  write_image(file, image, encoding);
}

std::string config_text() {
  return "seeds = [1, 2]\nsize = [48, 40]\ntile = 'both'\n"
         "[[exemplar]]\nname = \"" +
         odd_name +
         "\"\nimage = 'e.png'\nmaps = { 'wet & rough' = 'f.png' }\n"
         "[[exemplar]]\nname = 'plain'\nimage = 'f.png'\n"
         "[[exemplar]]\nname = 'broken'\nimage = '" +
         broken_path +
         "'\n"
         "[[method]]\nname = \"patch 'n' match\"\nkind = 'patchmatch'\n"
         "[[method]]\nname = 'quilting'\nkind = 'quilting'\npatch_size = 12\n"
         "[[method]]\nname = 'histogram'\nkind = 'histogram'\n"
         "[[method]]\nname = 'stone'\nkind = 'procedural'\ntexture = 'pebbles'\n"
         "[[preview]]\nname = 'a & b'\nonly = '*/quilting/seed2'\nsize = 24\nsamples = 1\n"
         "second = 'f.png'\n"
         "[[preview]]\nonly = '*/quilting/seed2'\nsize = 24\nsamples = 1\nshape = 'cube'\n";
}

class Page : public RunInBrowser {
 protected:
  // One run and one browser for all tests.
  static void SetUpTestSuite() {
    if (!make_folder("gramloom_page")) return;
    write_exemplar(folder_ / "e.png", 1);
    write_exemplar(folder_ / "f.png", 2);
    fs::create_directories((folder_ / broken_path).parent_path());
    write_text(folder_ / broken_path, "no picture");
    write_text(folder_ / "c.toml", config_text());
    const Outcome outcome = gramloom(folder_, {"run", "c.toml", "--quiet"});
    ASSERT_EQ(outcome.exit_code, 1) << "the broken exemplar's jobs fail: " << outcome.errors;
    start_browser();
  }

  static void open(Size window = desk, bool dark = false, const std::string& run = "out/c") {
    browser_->open(folder_ / run / "index.html", window, dark);
  }
};

TEST_F(Page, LoadsWithoutAWordOnTheConsoleAndWithEveryPicture) {
  for (const bool dark : {false, true})
    for (const Size window : {desk, phone}) {
      open(window, dark);
      EXPECT_EQ(pictures_missing(), 0);
      EXPECT_EQ(js("document.querySelectorAll('#rows img').length"), 2 + 2 * 3 * 2 + 2);
      EXPECT_THAT(browser_->problems(), IsEmpty());
      keep(fmt::format("page-{}-{}", window.width, dark ? "dark" : "light"));
    }
}

TEST_F(Page, OddNamesStayText) {
  open();
  EXPECT_EQ(js("[...document.querySelectorAll('#rows h3')].map((h) => h.textContent)"),
            (nlohmann::json{"procedural", odd_name, "plain", "broken"}));
  EXPECT_EQ(js("document.querySelectorAll('img[onerror], script').length"), 2)
      << "two scripts of ours";
  EXPECT_EQ(js("document.title"), "c · gramloom");
  EXPECT_THAT(text("#summary"), HasSubstr("20 jobs. 14 done, 6 failed"));
  EXPECT_THAT(text("#facts"), HasSubstr("run c.toml --quiet"));
}

TEST_F(Page, AFailedJobShowsItsErrorInItsPlace) {
  open();
  EXPECT_THAT(text("#first-failed"), HasSubstr(broken_path));
  EXPECT_GT(js("document.querySelector('#first-failed').getBoundingClientRect().height"), 60);
  click("#first-failed");
  EXPECT_THAT(text("#viewer .details"), HasSubstr(broken_path));
  EXPECT_THAT(text("#stage"), HasSubstr("failed"));
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Page, PicturesAreAtTheSameScaleAndNotSmoothed) {
  open();
  EXPECT_EQ(js("new Set([...document.querySelectorAll('#rows .picture img')].map((image) =>"
               " image.getBoundingClientRect().width / image.width)).size"),
            1);
  EXPECT_EQ(js("getComputedStyle(document.querySelector('#rows img')).imageRendering"),
            "pixelated");
}

// The numbers of a column of the table, as they stand; null where there is none.
std::string column(const std::string& score) {
  return "[...document.querySelectorAll('#table td[data-score=" + score +
         "]')]"
         ".map((cell) => cell.firstChild.data === '–' ? null : parseFloat(cell.firstChild.data))";
}

TEST_F(Page, AColumnSortsBothWaysAndItsBestIsMarked) {
  open();
  for (const std::string rows : {"a row for each method", "a row for each picture"}) {
    js("[...document.querySelectorAll('#table-controls button')].find((b) => b.innerText === '" +
       rows + "').click()");
    for (const std::string score : {"stsim2", "random_features"}) {
      const bool higher = score == "stsim2";
      const std::string heading = "#table [data-column=" + score + "]";
      click(heading);
      auto values = js(column(score)).get<std::vector<nlohmann::json>>();
      const auto missing = std::find(values.begin(), values.end(), nlohmann::json());
      EXPECT_GE(missing - values.begin(), 3);
      EXPECT_TRUE(
          std::all_of(missing, values.end(), [](const nlohmann::json& v) { return v.is_null(); }));
      const auto better = [&](const nlohmann::json& a, const nlohmann::json& b) {
        return higher ? a > b : a < b;
      };
      EXPECT_TRUE(std::is_sorted(values.begin(), missing, better)) << js(column(score));
      EXPECT_EQ(js("document.querySelector('" + heading + "').closest('th').ariaSort"),
                higher ? "descending" : "ascending");
      click(heading);
      values = js(column(score)).get<std::vector<nlohmann::json>>();
      const auto last = std::find(values.begin(), values.end(), nlohmann::json());
      EXPECT_TRUE(std::is_sorted(
          values.begin(), last,
          [&](const nlohmann::json& a, const nlohmann::json& b) { return better(b, a); }));
      EXPECT_EQ(js("[...document.querySelectorAll('#table td[data-score=" + score +
                   "].best')].at(-1).firstChild.data * 1"),
                *std::prev(last))
          << "the best of all is the last one now";
    }
  }
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Page, ThePictureFlipsInItsPlace) {
  open();
  enlarge(patch_job);
  const std::string shown = "[...document.querySelectorAll('#stage .layer:not([hidden]) img')]";
  const std::string place = shown + ".map((i) => JSON.stringify(i.getBoundingClientRect()))[0]";
  EXPECT_EQ(text("#stage .tag"), "A · patch 'n' match, seed 1");
  const nlohmann::json first = js(place);
  browser_->press(" ");
  EXPECT_EQ(text("#stage .tag"), "B · exemplar");
  EXPECT_THAT(js("decodeURIComponent(" + shown + "[0].src)").get<std::string>(),
              testing::EndsWith("/exemplar.png"));
  EXPECT_EQ(js(place), first);
  click("#stage");
  EXPECT_EQ(text("#stage .tag"), "A · patch 'n' match, seed 1");
  // Any two: the other one is chosen from a list.
  js("(() => { const b = document.querySelector('[data-keep=B]');"
     " b.value = 'plain/quilting/seed2'; b.dispatchEvent(new Event('change')); })()");
  EXPECT_EQ(text("#stage .tag"), "B · plain · quilting, seed 2");
  EXPECT_EQ(pictures_missing(), 0);
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Page, TwoByTwoTilesWithoutAGap) {
  open();
  enlarge(patch_job);
  browser_->press("t");
  const nlohmann::json corners =
      js("[...document.querySelectorAll('#stage .layer:not([hidden]) img')].map((i) => {"
         " const r = i.getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; })");
  ASSERT_EQ(corners.size(), 4u);
  EXPECT_EQ(corners[0][2], corners[1][0]);
  EXPECT_EQ(corners[0][3], corners[2][1]);
  EXPECT_EQ(corners[0][1], corners[1][1]);
  EXPECT_EQ(corners[3][0], corners[1][0]);
  EXPECT_EQ(corners[3][1], corners[2][1]);
  keep("viewer-tiled");
  browser_->press("t");
  browser_->press("c");
  EXPECT_THAT(
      js("document.querySelector('#stage .layer:not([hidden]) img').src").get<std::string>(),
      HasSubstr("copy_map"));
  EXPECT_EQ(pictures_missing(), 0);
  keep("viewer-copy-map");
}

TEST_F(Page, TheKeyboardIsEnough) {
  open();
  js("document.querySelectorAll('#rows .source ~ .results button')[0].focus()");
  browser_->press("Enter");
  EXPECT_EQ(js("document.querySelector('dialog').open"), true);
  EXPECT_EQ(text("#viewer-title span"), "patch 'n' match, seed 1");
  browser_->press("ArrowRight");
  EXPECT_EQ(text("#viewer-title span"), "patch 'n' match, seed 2");
  browser_->press("ArrowLeft");
  browser_->press("ArrowLeft");
  EXPECT_EQ(text("#viewer-title span"), "exemplar");
  browser_->press("ArrowLeft");
  EXPECT_EQ(text("#viewer-title span"), "histogram, seed 2") << "around the end";
  browser_->press("ArrowDown");
  EXPECT_THAT(text("#viewer-title"), HasSubstr("plain"));
  EXPECT_EQ(text("#viewer-title span"), "histogram, seed 2");
  EXPECT_THAT(js("decodeURIComponent(location.hash)").get<std::string>(),
              HasSubstr("plain/histogram/seed2"));
  browser_->press("Escape");
  wait();
  EXPECT_EQ(js("document.querySelector('dialog').open"), false);
  EXPECT_EQ(js("document.activeElement.dataset.id"), "plain/histogram/seed2") << "the focus stays";
}

TEST_F(Page, AnAddressOpensItsPicture) {
  open();
  enlarge(odd_name + "/quilting/seed1");
  const std::string address = js("location.href");
  browser_->press("Escape");
  wait();
  EXPECT_EQ(js("location.hash"), "");
  js("location.hash = " + nlohmann::json(address.substr(address.find('#'))).dump());
  wait();
  EXPECT_EQ(text("#viewer-title span"), "quilting, seed 1");
}

TEST_F(Page, NothingIsWiderThanAPhone) {
  open(phone);
  const std::string widest = "document.documentElement.scrollWidth";
  EXPECT_EQ(js(widest), 390);
  for (const std::string size : {"½", "4", "auto"}) {
    js("[...document.querySelectorAll('.toolbar .segments button')].find((b) => b.innerText === '" +
       size + "').click()");
    EXPECT_EQ(js(widest), 390) << size;
  }
  js("document.querySelectorAll('#table-controls button')[1].click()");
  EXPECT_EQ(js(widest), 390) << "the long table scrolls in itself";
  keep("table-390");
  enlarge(patch_job);
  EXPECT_EQ(js("document.querySelector('dialog').scrollWidth"), 390);
  keep("viewer-390");
  browser_->press("t");
  EXPECT_EQ(js("document.querySelector('dialog').scrollWidth"), 390);
}

TEST_F(Page, DarkFollowsTheSystemAndTheButton) {
  const std::string brightness =
      "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)[0]";
  open(desk, true);
  js("localStorage.clear()");
  open(desk, true);
  EXPECT_LT(js(brightness), 60);
  click("#theme");
  EXPECT_EQ(text("#theme"), "light");
  EXPECT_GT(js(brightness), 200);
  open(desk, true);
  EXPECT_GT(js(brightness), 200) << "it is remembered";
  click("#theme");
  EXPECT_LT(js(brightness), 60);
  click("#theme");
  EXPECT_EQ(text("#theme"), "auto");
  open(desk, false);
  EXPECT_GT(js(brightness), 200);
}

TEST_F(Page, PlotsFollowTheChosenScore) {
  open();
  EXPECT_EQ(js("document.querySelectorAll('#plot-time .point').length"), 12);
  EXPECT_EQ(js("document.querySelectorAll('#plot-time .mean').length"), 3);
  EXPECT_EQ(js("document.querySelectorAll('#plot-methods .mean').length"), 3);
  EXPECT_EQ(js("document.querySelectorAll('#plot-loss .series').length"), 4);
  EXPECT_THAT(text("#plot-time svg"), HasSubstr("stsim2 ↑"));
  js("(() => { const s = document.querySelectorAll('.toolbar select')[1];"
     " s.value = 'copied_share'; s.dispatchEvent(new Event('change')); })()");
  EXPECT_THAT(text("#plot-time svg"), HasSubstr("copied share ↓"));
  EXPECT_THAT(text("#pictures-note"), HasSubstr("copied share, lower is better"));
  const std::string axis = "#plot-loss svg .axis";
  EXPECT_EQ(text(axis), "steps");
  js("[...document.querySelectorAll('#plot-loss button')][1].click()");
  EXPECT_EQ(text(axis), "seconds");
  EXPECT_EQ(js("/NaN|Infinity|undefined/.test(document.querySelector('main').innerHTML)"), false);
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Page, ExemplarsAndMethodsCanBeChosen) {
  open();
  js("(() => { const s = document.querySelector('.toolbar select');"
     " s.value = 'plain'; s.dispatchEvent(new Event('change')); })()");
  EXPECT_EQ(js("document.querySelectorAll('#rows .row').length"), 1);
  EXPECT_EQ(js("document.querySelectorAll('#rows .results figure').length"), 6);
  click(".chips button:nth-child(2)");
  EXPECT_EQ(js("document.querySelectorAll('#rows .results figure').length"), 4);
  EXPECT_EQ(js("document.querySelectorAll('#table tbody tr').length"), 2);
  for (const int chip : {1, 3, 4}) click(fmt::format(".chips button:nth-child({})", chip));
  EXPECT_EQ(text("#rows"), "Nothing is chosen.");
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Page, ItsCommandAndItsSettingsMakeThePictureAgain) {
  open();
  enlarge(odd_name + "/quilting/seed2");
  const std::string job = odd_name + "/quilting/seed2.png";
  ASSERT_THAT(js("decodeURIComponent(document.querySelector('#stage img').src)").get<std::string>(),
              testing::EndsWith(job));
  const std::string picture = read_text(folder_ / "out/c" / job);
  fs::remove(folder_ / "out/c" / job);
  const Outcome again = shell(folder_, text("#command"));
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_TRUE(read_text(folder_ / "out/c" / job) == picture);

  write_text(folder_ / "settings.toml", text("#settings"));
  const Outcome alone = gramloom(folder_, {"run", "settings.toml", "--quiet"});
  EXPECT_EQ(alone.exit_code, 0) << alone.errors;
  EXPECT_TRUE(read_text(folder_ / "out/settings" / job) == picture);
  for (const std::string preview : {"preview", "preview_a & b"}) {
    const std::string file = odd_name + "/quilting/seed2_" + preview + ".png";
    EXPECT_TRUE(read_text(folder_ / "out/settings" / file) == read_text(folder_ / "out/c" / file))
        << preview;
  }
  click("#viewer .code .copy");
  wait();
  EXPECT_EQ(text("#viewer .code .copy"), "copied");
}

TEST_F(Page, FloatPicturesAndNoScoresAreShownToo) {
  write_exemplar(folder_ / "e.exr", 3, {PixelType::half, "Linear", {}});
  write_text(folder_ / "float.toml",
             "size = 32\nscores = false\n[[exemplar]]\nname = 'e'\nimage = 'e.exr'\n"
             "[[method]]\nname = 'quilting'\nkind = 'quilting'\npatch_size = 8\n");
  ASSERT_EQ(gramloom(folder_, {"run", "float.toml", "--quiet"}).exit_code, 0);
  ASSERT_TRUE(fs::exists(folder_ / "out/float/e/quilting/seed1.exr"));
  open(desk, false, "out/float");
  EXPECT_EQ(pictures_missing(), 0);
  EXPECT_EQ(js("document.querySelectorAll('#rows img').length"), 2);
  EXPECT_EQ(js("document.querySelectorAll('#table td[data-score]').length"), 2)
      << "time and memory";
  enlarge("e/quilting/seed1");
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

}  // namespace
}  // namespace gramloom
