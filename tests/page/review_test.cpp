// Looking through a run in a real browser: what changed, what is picked, keys, sequences, and many
// pictures. Skipped where there is no Chromium.
#include <chrono>

#include "cli/process.h"
#include "core/random.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "page/run_in_browser.h"
#include "runs/frames.h"
#include "runs/record.h"

namespace gramloom {
namespace {

using testing::Not;

void invert(const fs::path& picture) {
  ImageFile file = read_image(picture);
  for (float& value : file.image.pixels) value = 1 - value;
  write_image(picture, file.image, file.encoding, file.metadata);
}

class Review : public RunInBrowser {
 protected:
  static void SetUpTestSuite() {
    if (!make_folder("gramloom_review")) return;
    Image image(48, 40, 3);
    Random random(1);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < 3; ++c)
          image.at(x, y)[c] =
              0.2f + 0.3f * static_cast<float>((x / 6 + y / 5) % 2) + 0.3f * random.uniform();
    write_image(folder_ / "e.png", image, {});
    write_image(folder_ / "h.png", extract_channels(image, 0, 1), {});
    write_text(folder_ / "c.toml",
               "seeds = [1, 2]\nsize = [48, 40]\n[[exemplar]]\nname = \"it's 100% #1\"\n"
               "image = 'e.png'\nmaps = { height = 'h.png' }\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 12\n"
               "[[method]]\nname = 'p'\nkind = 'phase'\n");
    ASSERT_EQ(gramloom(folder_, {"run", "c.toml", "--quiet", "--output", "before"}).exit_code, 0);
    invert(folder_ / "before" / (job + ".png"));
    fs::remove(folder_ / "before" / (job + "_other.png"));
    JobRecord record = read_record(folder_ / "before" / (job + ".json"));
    record.metrics["spectrum_db"] = 0.01;
    write_record(folder_ / "before" / (job + ".json"), record);
    invert(folder_ / "before" / lost / "seed2.png");
    ASSERT_EQ(
        gramloom(folder_, {"run", "c.toml", "--quiet", "--output", "now", "--baseline", "before"})
            .exit_code,
        1);
    // One of the earlier pictures is gone.
    fs::remove(folder_ / "before" / lost / "seed2.png");
    fs::remove(folder_ / "now/page/before" / lost / "seed2.png");
    make_frames(folder_ / "now/models/folds_frames");
    ASSERT_EQ(gramloom(folder_, {"report", "now"}).exit_code, 0);
    start_browser();
  }
  static void make_frames(const fs::path& folder) {
    fs::create_directories(folder);
    for (int i = 0; i < 5; ++i) {
      Image frame(16, 16, 1);
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
          frame.at(x, y)[0] = static_cast<float>(x * i) - static_cast<float>(y);
      write_image(frame_files(folder, 5, "exr").at(static_cast<std::size_t>(i)), frame,
                  {PixelType::half, "", {}},
                  {{inferred_mark, nlohmann::json{{"bend", 10 * i}}.dump()}});
    }
  }
  static void open(Size window = desk, bool dark = false) {
    browser_->open(folder_ / "now/index.html", window, dark);
  }
  void SetUp() override {
    RunInBrowser::SetUp();
    if (!browser_) return;
    open();
    js("localStorage.clear()");
    open();
  }
  static std::string title() { return text("#viewer-title span"); }

  inline static const std::string lost = "it's 100% #1/q";
  inline static const std::string job = "it's 100% #1/q/seed1";
};

TEST_F(Review, WhatChangedStandsOnThePage) {
  EXPECT_EQ(pictures_missing(), 0);
  EXPECT_THAT(text("#changes-note"), HasSubstr("Compared with before: "));
  EXPECT_THAT(text("#changes-note"), HasSubstr("2 pictures have other bytes"));
  EXPECT_EQ(js("document.querySelectorAll('.change').length"), 2);
  EXPECT_THAT(text(".change"), HasSubstr(job));
  EXPECT_THAT(text(".change"), HasSubstr("spectrum_db: 0.01 → "));
  EXPECT_THAT(text(".change"), HasSubstr("worse"));
  EXPECT_EQ(js("document.querySelectorAll('.change img').length"), 3);
  EXPECT_THAT(text("#change-cards"), HasSubstr("no longer there: before/" + lost + "/seed2.png"));
  EXPECT_THAT(browser_->problems(), IsEmpty());
  keep("changes");
  open(phone, true);
  EXPECT_EQ(js("document.documentElement.scrollWidth"), 390);
  keep("changes-390-dark");
}

TEST_F(Review, TheEarlierPictureLiesOverTheNewOneBehindASlider) {
  click(".change .picture");
  EXPECT_EQ(title(), "q, seed 1");
  const std::string old = "document.querySelector('#stage .old img')";
  EXPECT_THAT(js("decodeURIComponent(" + old + ".src)").get<std::string>(),
              testing::EndsWith("page/before/" + job + ".png"));
  EXPECT_EQ(js("JSON.stringify(" + old + ".getBoundingClientRect())"),
            js("JSON.stringify(document.querySelector('#stage .layer:not(.old) "
               "img').getBoundingClientRect())"));
  const std::string clip = "getComputedStyle(" + old + ").clipPath";
  EXPECT_THAT(js(clip).get<std::string>(), HasSubstr("50%"));
  js("document.getElementById('cut').focus()");
  for (int i = 0; i < 3; ++i) browser_->press("ArrowRight");
  EXPECT_GT(js("Number(document.getElementById('cut').value)"), 50) << "by the keyboard too";
  EXPECT_THAT(js(clip).get<std::string>(), Not(HasSubstr(" 50%")));
  keep("before-slider");
  js("[...document.querySelectorAll('.viewer-controls button')].find((b) => b.innerText === 'side "
     "by side').click()");
  EXPECT_EQ(js("document.querySelectorAll('#stage .half img').length"), 2);
  EXPECT_EQ(pictures_missing(), 0);
  keep("before-beside");
  EXPECT_THAT(text(".own-scores"), HasSubstr("was 0.0"));
  browser_->press("j");
  EXPECT_EQ(title(), "q, seed 2");
  EXPECT_THAT(text("#stage"), HasSubstr("no longer there"));
  browser_->press("b");
  EXPECT_EQ(js("document.querySelectorAll('#stage .old').length"), 0);
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Review, PicksAreKeptAndTheCommandCopiesThem) {
  EXPECT_EQ(js("document.getElementById('picks').hidden"), true);
  click("#rows .pick");
  js("document.querySelector('#rows .picture[data-id=\"it\\'s 100% #1/p/seed2\"]').focus()");
  browser_->press("p");
  EXPECT_THAT(text("#picks strong"), HasSubstr("2 picked"));
  keep("picks");
  open();
  EXPECT_THAT(text("#picks strong"), HasSubstr("2 picked")) << "they survive a reload";
  EXPECT_EQ(js("document.querySelectorAll('#rows .pick[aria-pressed=true]').length"), 2);
  const Outcome picked = shell(folder_, text("#pick-command"));
  ASSERT_EQ(picked.exit_code, 0) << picked.errors << text("#pick-command");
  EXPECT_TRUE(read_text(folder_ / "picked" / (job + ".png")) ==
              read_text(folder_ / "now" / (job + ".png")));
  EXPECT_TRUE(fs::exists(folder_ / "picked/it's 100% #1/p/seed2.toml"));
  js("[...document.querySelectorAll('#picks button')].find((b) => b.innerText === 'show these "
     "only').click()");
  EXPECT_EQ(js("document.querySelectorAll('#rows .results figure').length"), 2);
  enlarge(job);
  browser_->press("p");
  EXPECT_EQ(js("document.querySelector('#viewer .pick').ariaPressed"), "false");
  js("dialog.close()");
  js("[...document.querySelectorAll('#picks button')].find((b) => b.innerText === 'clear')"
     ".click()");
  EXPECT_EQ(js("document.querySelectorAll('#rows .results figure').length"), 4);
  EXPECT_EQ(js("document.getElementById('picks').hidden"), true);
  js("localStorage.setItem(picksKey, '{\"nobody\": 1}')");
  open();
  EXPECT_THAT(browser_->problems(), IsEmpty()) << "what others left there";
}

TEST_F(Review, ManyNamesAreAList) {
  js("HTMLAnchorElement.prototype.click = () => {};"
     "URL.createObjectURL = (blob) => { window.list = blob; return ''; };"
     "togglePick(subjectById.get(data.jobs[1].name)); downloadPicks()");
  EXPECT_EQ(js("list.text()"), js("data.jobs[1].name").get<std::string>() + "\n");
  js("for (let i = 0; i < 12; ++i) { data.jobs.push({ name: 'x' + i }); picks.add('x' + i); }"
     "drawPicks()");
  EXPECT_THAT(text("#pick-command"), HasSubstr("--list picks.txt"));
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Review, KeysGoThroughThePicturesAndTellOfThemselves) {
  browser_->press("?");
  EXPECT_EQ(js("document.getElementById('help').open"), true);
  EXPECT_THAT(text("#help"), HasSubstr("pick the picture"));
  keep("help");
  browser_->press("Escape");
  wait();
  EXPECT_EQ(js("document.getElementById('help').open"), false);
  const auto focused = [] { return js("document.activeElement.dataset.id ?? ''"); };
  browser_->press("j");
  EXPECT_EQ(focused(), "it's 100% #1");
  browser_->press("j");
  browser_->press("ArrowRight");
  EXPECT_EQ(focused(), "it's 100% #1/q/seed2");
  browser_->press("k");
  EXPECT_EQ(focused(), job);
  EXPECT_NE(js("getComputedStyle(document.activeElement).outlineStyle"), "none");
  browser_->press("Enter");
  browser_->press("?");
  EXPECT_EQ(js("document.getElementById('help').open"), true) << "over the picture";
  browser_->press("Escape");
  wait();
  EXPECT_EQ(js("dialog.open"), true);
  browser_->press("k");
  EXPECT_EQ(title(), "exemplar");
  // Every control says what it is.
  EXPECT_EQ(js("[...document.querySelectorAll('button, input, select')].filter((e) => "
               "!(e.ariaLabel || e.innerText || e.title || e.closest('label'))).length"),
            0);
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

TEST_F(Review, ASequenceIsPlayedByASlider) {
  EXPECT_EQ(js("document.querySelectorAll('.sequence .strip img').length"), 5);
  EXPECT_THAT(text(".sequence figcaption"), HasSubstr("1 of 5: bend 0"));
  js("(() => { const s = document.querySelector('.sequence input');"
     " s.value = 4; s.dispatchEvent(new Event('input')); })()");
  EXPECT_THAT(text(".sequence figcaption"), HasSubstr("4 of 5: bend 30"));
  EXPECT_THAT(js("document.querySelector('.sequence figure img').src").get<std::string>(),
              testing::EndsWith("frame_0004.exr.png"));
  EXPECT_EQ(pictures_missing(), 0);
  js("document.getElementById('sequences').scrollIntoView()");
  keep("sequence");
}

// The page of as many jobs, each with a picture of its own: the first one again and again.
void write_page_of_many(const fs::path& run, int count) {
  std::string html = read_text(run / "index.html");
  const std::size_t start = html.find("id=\"data\">") + 10, end = html.find("</script>", start);
  nlohmann::json data = nlohmann::json::parse(html.substr(start, end - start));
  nlohmann::json jobs = nlohmann::json::array();
  fs::create_directories(run / "many");
  for (int i = 0; i < count; ++i) {
    nlohmann::json job = data["jobs"][0];
    const std::string file = fmt::format("many/{}.png", i);
    fs::copy_file(run / job["pictures"][0]["file"].get<std::string>(), run / file);
    job["name"] = fmt::format("{}/q/seed{}", job["exemplar"].get<std::string>(), i);
    job["seed"] = i;
    job["pictures"] = {{{"label", "picture"}, {"file", file}}};
    jobs.push_back(job);
  }
  data["jobs"] = jobs;
  write_text(run / "many.html", html.replace(start, end - start, data.dump()));
}

// Many pictures: the page is there at once, and loads those that are seen.
TEST_F(Review, TwoThousandPicturesOpenAndLoadWhenTheyAreSeen) {
  write_page_of_many(folder_ / "now", 2000);
  const auto started = std::chrono::steady_clock::now();
  browser_->open(folder_ / "now/many.html", desk);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  RecordProperty("seconds", fmt::format("{:.1f}", took.count()));
  EXPECT_LT(took.count(), 60) << "about one; a busy machine is slow";
  const std::string images = "[...document.querySelectorAll('#rows .results img')]";
  EXPECT_EQ(js(images + ".length"), 2000);
  const auto loaded = [&] {
    return js(images + ".filter((i) => i.complete && i.naturalWidth > 0).length").get<int>();
  };
  EXPECT_LT(loaded(), 1000);
  const std::string last = images + "[1999]";
  js(last + ".scrollIntoView()");
  EXPECT_EQ(js(last + ".decode().then(() => true)"), true);
  EXPECT_LT(loaded(), 2000) << "those between are passed over";
  js("openViewer(subjects[1000])");
  EXPECT_LT(js("document.querySelectorAll('.strip img').length"), 100);
  EXPECT_THAT(browser_->problems(), IsEmpty());
}

}  // namespace
}  // namespace gramloom
