#include "core/modules.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace gramloom {
namespace {

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

}  // namespace
}  // namespace gramloom
