// Nesting of TOML: a file does not choose how deep our stack goes; and errors of its parser.
#include <gmock/gmock.h>

#include "io/temp_folder.h"
#include "io/toml_reader.h"

namespace gramloom {
namespace {

using testing::HasSubstr;

std::string repeat(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

TEST(TomlNesting, TooDeepIsALineWithItsPlace) {
  const int many = 60'000;
  for (const std::string& text :
       {"\n\na" + repeat(".a", many) + "=1", "\n\n[a" + repeat(".a", many) + "]",
        "\n\n[[a" + repeat(". \"a\" ", many) + "]]", "\n\na=" + repeat("[", many),
        "\n\na=" + repeat("{a=", many), "\n\na=" + repeat("[{a=", many),
        "\n\na={a" + repeat(".'.'", many) + "=1}"})
    EXPECT_EQ(error_of([&] { parse_toml(text, "c.toml"); }), "c.toml:3: nested deeper than 50");
}

TEST(TomlNesting, BracketsAndDotsInTextsAndCommentsNestNothing) {
  const std::string deep = repeat("[.{", 1000);
  const toml::table table =
      parse_toml("# " + deep + "\na = \"\\\"" + deep + "\"\nb = '" + deep + "'\nc = \"\"\"\n\"" +
                     deep + "\n\"\"\"\nd = '''" + deep + "\n'" + deep + "'''\ne = [" +
                     repeat("1.5, [2.5],\n", 500) + "]\n" + repeat("[[x.y]]\nz.w = 1\n", 100),
                 "c.toml");
  EXPECT_EQ(table.size(), 6u);
}

TEST(TomlNesting, AnOverrideTooDeepIsAWord) {
  const std::string value = repeat("[", 60'000);
  const toml::table table = parse_override("size", value, "size=...");
  EXPECT_EQ(table.get("size")->value<std::string>(), value);
}

// Found by fuzzing.
TEST(TomlErrors, AreOneLineAlsoWhereTheParserSawALinesEnd) {
  EXPECT_EQ(error_of([&] { parse_toml("a =t\nb = 1\n", "c.toml"); }),
            "c.toml:1:5: Error while parsing boolean: expected 'true', saw 't\\n'");
}

}  // namespace
}  // namespace gramloom
