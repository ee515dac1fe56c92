// The programs in examples/: they run, make what they promise, and docs/library.md quotes them as
// they are.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "cli/process.h"
#include "core/error.h"
#include "core/image.h"
#include "io/image_file.h"
#include "io/temp_folder.h"
#include "io/text_file.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// An example, in the test's own folder. In `arguments`, $DATA is the folder of shipped exemplars.
class Example : public TempFolder {
 protected:
  Outcome run(const std::string& name, const std::string& arguments) const {
    const Outcome outcome =
        shell(path(), "DATA='" + (source_folder() / "data").string() + "'; exec '" +
                          GRAMLOOM_EXAMPLES "/" + name + "' " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output << outcome.errors;
    return outcome;
  }
  Image picture(const std::string& name) const { return read_image(path(name)).image; }
};

// Of neighbouring pixels, across the seams (or inside) of the picture on an axis.
double mean_step(const Image& image, bool along_x, bool at_the_seam) {
  double sum = 0;
  int steps = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int nx = along_x ? (x + 1) % image.width : x;
      const int ny = along_x ? y : (y + 1) % image.height;
      if ((nx < x || ny < y) != at_the_seam) continue;
      sum += std::abs(double{*image.at(nx, ny)} - double{*image.at(x, y)});
      ++steps;
    }
  return sum / steps;
}

void expect_tiles(const Image& image) {
  for (const bool along_x : {true, false})
    EXPECT_LT(mean_step(image, along_x, true), 2 * mean_step(image, along_x, false));
}

bool is_flat(const Image& image) {
  const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  return *most - *least < 0.1f;
}

TEST_F(Example, QuiltingMakesATextureThatTiles) {
  run("quilting", "$DATA/brick.png wall.png");
  const Image wall = picture("wall.png");
  EXPECT_EQ(wall.size(), (Size{512, 512}));
  EXPECT_EQ(wall.channels, 3);
  EXPECT_FALSE(is_flat(wall));
  expect_tiles(wall);
}

TEST_F(Example, MarbleIsCutTwice) {
  run("marble", "front.png inside.png");
  const Image front = picture("front.png"), inside = picture("inside.png");
  EXPECT_EQ(front.size(), (Size{384, 256}));
  EXPECT_FALSE(is_flat(front));
  EXPECT_NE(front, inside);
}

TEST_F(Example, ScoresTellAnExemplarFromAnotherTexture) {
  const std::string output = run("scores", "$DATA/sand.png $DATA/sand.png $DATA/brick.png").output;
  EXPECT_THAT(output, HasSubstr("stsim2               1.0000"));
  EXPECT_THAT(output, HasSubstr("copied_share         1.0000"));
  std::vector<double> values;
  const std::regex line(R"(stsim2 +([0-9.]+))");
  for (std::sregex_iterator it(output.begin(), output.end(), line), end; it != end; ++it)
    values.push_back(std::stod((*it)[1]));
  ASSERT_EQ(values.size(), 2u);
  EXPECT_LT(values[1], 0.95);
}

TEST_F(Example, MethodsMakeOnePictureEach) {
  const std::string output = run("methods", "$DATA/pebbles.png .").output;
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 4);
  for (const std::string name : {"quilting", "patchmatch", "pyramid", "phase"}) {
    EXPECT_THAT(output, HasSubstr(name));
    EXPECT_EQ(picture(name + ".png").size(), (Size{192, 192}));
    EXPECT_FALSE(is_flat(picture(name + ".png")));
    expect_tiles(picture(name + ".png"));
  }
}

TEST_F(Example, NeuralReportsItsProgress) {
  const std::string output = run("neural", "$DATA/granite.png new.png").output;
  EXPECT_THAT(output, HasSubstr("expected: "));
  EXPECT_THAT(output, HasSubstr("step 25 of "));
  EXPECT_EQ(picture("new.png").size(), (Size{128, 128}));
  EXPECT_FALSE(is_flat(picture("new.png")));
  expect_tiles(picture("new.png"));
}

TEST_F(Example, AMistakeIsOneLine) {
  for (const std::string command :
       {"quilting none.png x.png", "quilting", "marble", "scores", "methods", "neural"}) {
    const Outcome outcome = shell(path(), GRAMLOOM_EXAMPLES "/" + command);
    EXPECT_EQ(outcome.exit_code, 1) << command;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  }
}

// Each block of C++ there is a part of an example: what can be copied from there compiles.
TEST(Documents, QuoteTheExamplesAsTheyAre) {
  std::vector<std::string> examples;
  for (const auto& file : fs::directory_iterator(source_folder() / "examples"))
    if (file.path().extension() == ".cpp") examples.push_back(read_text(file.path()));
  ASSERT_GE(examples.size(), 3u);
  const std::string page = read_text(source_folder() / "docs/library.md");
  const std::string fence = "```cpp\n";
  int quotations = 0;
  for (auto at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    const std::string quotation = page.substr(at, page.find("```", at) - at);
    EXPECT_TRUE(std::any_of(
        examples.begin(), examples.end(),
        [&](const std::string& text) { return text.find(quotation) != std::string::npos; }))
        << "no example has this:\n"
        << quotation;
    ++quotations;
  }
  EXPECT_GE(quotations, 1);
}

}  // namespace
}  // namespace gramloom
