#include "core/modules.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "core/build_stamp.h"
#include "core/error.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

struct Absent {
  static constexpr std::string_view name = "absent";
};

TEST(Modules, OneThatIsNotInstalledIsNamedWithItsPackage) {
  try {
    open_module<Absent>();
    FAIL() << "opened";
  } catch (const Error& error) {
    EXPECT_THAT(
        error.what(),
        testing::EndsWith("/libgramloom_absent.so is missing: install the package gramloom, "
                          "or in a checkout run ./bootstrap build"));
  }
}

// Of this program's test, that runs beside others. Nothing of it may be opened: it is no library.
struct Other {
  static constexpr std::string_view name = "of_another_build";
};

TEST(Modules, OneOfAnotherBuildIsRefusedBeforeItIsOpened) {
  const fs::path module = libraries_folder() / "libgramloom_of_another_build.so",
                 list = libraries_folder() / "libgramloom_of_another_build.txt";
  const auto said = [&] {
    try {
      open_module<Other>();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("opened");
  };
  const std::string refused = module.string() +
                              " is of another build than the program: in a checkout run "
                              "./bootstrap build, or install the package gramloom anew";
  std::ofstream(module) << "no library";
  EXPECT_EQ(said(), refused) << "without a stamp";
  std::ofstream(list) << "0123456789ab\nlibm.so.6\n";
  EXPECT_EQ(said(), refused);
  std::ofstream(list) << build_stamp() << "\n";
  EXPECT_THAT(said(), testing::HasSubstr("cannot be opened: " + module.string()));
  fs::remove(module);
  fs::remove(list);
}

TEST(Modules, AStampIsTwelveDigits) {
  EXPECT_THAT(std::string(build_stamp()), testing::MatchesRegex("[0-9a-f]{12}"));
}

}  // namespace
}  // namespace gramloom
