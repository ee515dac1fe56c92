// The exemplars that we ship are what their config makes, value for value.
#include "cli/workspace.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Exemplars : public Workspace {};

// Of the files themselves, the compression differs between versions of zlib and libpng.
void expect_same(const fs::path& shipped, const fs::path& made) {
  const ImageFile there = read_image(shipped), here = read_image(made);
  EXPECT_EQ(there.image.size(), here.image.size()) << shipped;
  EXPECT_EQ(there.image.channels, here.image.channels) << shipped;
  EXPECT_TRUE(there.image == here.image) << shipped;
  EXPECT_TRUE(there.encoding == here.encoding) << shipped;
  EXPECT_EQ(there.metadata, here.metadata) << shipped;
}

TEST_F(Exemplars, AreWhatTheirConfigMakes) {
  const fs::path data = source_folder() / "data";
  const Outcome made =
      run({"run", (data / "exemplars.toml").string(), "--output", "made", "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "made/procedural")) {
    const std::string name = entry.path().filename().string();
    for (const auto& file : fs::directory_iterator(entry.path())) {
      if (file.path().extension() != ".png") continue;
      const std::string map = file.path().stem().string().substr(std::string("seed1").size());
      const fs::path shipped = data / (name + map + ".png");
      ++pictures;
      ASSERT_TRUE(fs::exists(shipped)) << shipped;
      expect_same(shipped, file.path());
    }
  }
  EXPECT_GE(pictures, 12);
}

}  // namespace
}  // namespace gramloom
