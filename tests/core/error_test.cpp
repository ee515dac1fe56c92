#include "core/error.h"

#include <gtest/gtest.h>

namespace gramloom {
namespace {

TEST(Error, IsOneLineWhateverItQuotes) {
  const Error error("{}: '{}' is no number", "a\nb.csv", "\x1b[2J\r\t\x7f");
  EXPECT_STREQ(error.what(), "a\\nb.csv: '\\x1b[2J\\r\\t\\x7f' is no number");
}

TEST(Error, KeepsWhatIsNoControlCharacter) {
  const ConfigError error("{} of 100%: {{}} \\ {}", "Körnung", "\xff");
  EXPECT_STREQ(error.what(), "Körnung of 100%: {} \\ \xff");
}

}  // namespace
}  // namespace gramloom
