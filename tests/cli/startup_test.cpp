// What the executable loads: libraries that bring many others along only for the jobs that need
// them.
#include <sstream>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Startup : public Workspace {
 protected:
  Startup() {
    write_text(folder_ / "formula.toml",
               "size = [32, 32]\n[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'noise'\n");
    write_text(folder_ / "neural.toml",
               "size = [32, 32]\nscores = false\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
               "[[method]]\nname = 'n'\nkind = 'neural'\niterations = 1\npatch_sizes = [3]\n");
  }

  // One line a library that the command loaded, and why, as the dynamic linker reports it.
  std::string libraries(const std::string& arguments, int exit_code = 0) const {
    const Outcome outcome =
        shell(folder_, "LD_DEBUG=files LD_DEBUG_OUTPUT=loaded $GRAMLOOM " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.errors;
    std::string lines;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (!entry.path().filename().string().starts_with("loaded.")) continue;
      std::istringstream text(read_text(entry.path()));
      for (std::string line, last; std::getline(text, line); last = line)
        if (line.find("generating link map") != std::string::npos) lines += last + "\n";
      fs::remove(entry.path());
    }
    EXPECT_NE(lines, "") << arguments;
    return lines;
  }
};

bool has_torch(const std::string& libraries) {
  return libraries.find("libtorch") != std::string::npos ||
         libraries.find("libgramloom_neural") != std::string::npos;
}
bool has_openimageio(const std::string& libraries) {
  return libraries.find("libOpenImageIO") != std::string::npos;
}

TEST_F(Startup, WhatNeedsNoPictureLoadsFewLibraries) {
  for (const std::string command :
       {"--help", "--version", "run --help", "list", "check formula.toml"}) {
    const std::string loaded = libraries(command);
    EXPECT_FALSE(has_torch(loaded)) << command;
    EXPECT_FALSE(has_openimageio(loaded)) << command;
    EXPECT_LT(std::count(loaded.begin(), loaded.end(), '\n'), 50) << command << "\n" << loaded;
  }
}

TEST_F(Startup, OnlyANeuralJobLoadsLibTorch) {
  for (const std::string command :
       {"check c.toml", "check neural.toml", "run c.toml --quiet", "report out/c",
        "score e.png out/c/e/q/seed1.png", "run formula.toml --quiet"}) {
    EXPECT_FALSE(has_torch(libraries(command))) << command;
  }
  const std::string neural = libraries("run neural.toml --quiet");
  EXPECT_TRUE(has_torch(neural));
  EXPECT_TRUE(has_openimageio(neural));
  EXPECT_TRUE(fs::exists(folder_ / "out/neural/e/n/seed1.png"));
}

TEST_F(Startup, LibrariesOfAModuleAreOpenedByThemselves) {
  // All at once would take twice as long: see core/modules.cpp.
  std::istringstream loaded(libraries("run c.toml --quiet"));
  int by_themselves = 0;
  for (std::string line; std::getline(loaded, line);)
    if (line.find("dynamically loaded by") != std::string::npos) ++by_themselves;
  EXPECT_GT(by_themselves, 50) << loaded.str();
}

TEST_F(Startup, ErrorsOfAModuleAreErrorsOfTheProgram) {
  write_text(folder_ / "broken.png", "this is no picture");
  const Outcome unread = run({"score", "e.png", "broken.png"});
  EXPECT_EQ(unread.exit_code, 1);
  EXPECT_TRUE(unread.errors.starts_with("gramloom: broken.png: not an image")) << unread.errors;
  // Only the module looks into the file of weights.
  write_text(folder_ / "w.safetensors", "no weights");
  const Outcome failed = run({"run", "neural.toml", "--quiet", "--set", "preset=gatys", "--set",
                              "network=vgg_small", "--set", "weights=w.safetensors"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.errors.find("w.safetensors: "), std::string::npos) << failed.errors;
}

TEST_F(Startup, AMissingModuleFailsTheJobsThatNeedIt) {
  // Modules are looked for beside the library of core/.
  ASSERT_EQ(shell(folder_,
                  "mkdir part && cp \"$(dirname \"$GRAMLOOM\")\"/libgramloom_core.so "
                  "\"$(dirname \"$GRAMLOOM\")\"/libgramloom_pictures.* part")
                .exit_code,
            0);
  const Outcome outcome = shell(folder_,
                                "LD_LIBRARY_PATH=part $GRAMLOOM run neural.toml --quiet; "
                                "LD_LIBRARY_PATH=part $GRAMLOOM run c.toml --quiet");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_NE(outcome.errors.find("libgramloom_neural.so"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(fs::exists(folder_ / "out/neural/e/n/seed1.png"));
  EXPECT_TRUE(fs::exists(folder_ / "out/c/e/q/seed1.png"));
}

}  // namespace
}  // namespace gramloom
