#include "io/json_text.h"

#include <gmock/gmock.h>

#include "io/safetensors.h"
#include "io/temp_folder.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using JsonText = TempFolder;

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

TEST_F(JsonText, ComesBackInItsOrder) {
  const std::string text = R"({"b":[1,2.5,"\"[{é\\"],"a":{"null":null}})";
  EXPECT_EQ(to_text(parse_json(text)), text);
}

TEST_F(JsonText, AFileDoesNotChooseHowDeepOurStackGoes) {
  EXPECT_EQ(to_text(parse_json(nested(100))), nested(100));
  for (const std::string& text :
       {nested(101), nested(200'000), std::string(200'000, '['), std::string(200'000, '[') + '1'}) {
    EXPECT_THAT(error_of([&] { parse_json(text); }), HasSubstr("nested deeper than 100"));
    write_text(path("a.json"), text);
    EXPECT_THAT(error_of([&] { read_json(path("a.json")); }),
                testing::StartsWith(path("a.json").string() + ": not JSON: "));
  }
  // Brackets in a text nest nothing, and lists beside each other neither.
  const std::string flat = "[\"" + std::string(200'000, '[') + "\\\"[\",[],[],{}]";
  EXPECT_EQ(to_text(parse_json(flat)), flat);
}

TEST_F(JsonText, HeadersOfTensorsAreReadTheSameWay) {
  const std::string header = R"({"a":)" + nested(200'000) + "}";
  const std::uint64_t length = header.size();
  write_text(path("a.safetensors"),
             std::string(reinterpret_cast<const char*>(&length), sizeof length) + header);
  EXPECT_THAT(error_of([&] { read_tensors(path("a.safetensors")); }),
              HasSubstr("a.safetensors: the header is not valid JSON: lists in lists"));
}

TEST_F(JsonText, WhatIsNoJsonIsOneLineWithoutTheLibrarysName) {
  for (const std::string text : {"", "{", "[1,]", "nul", "{\"a\":1}x", "\"caf\xe9\"", "\n\n\n"}) {
    const std::string error = error_of([&] { parse_json(text); });
    EXPECT_EQ(error.find("[json"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    EXPECT_THAT(error, HasSubstr("line "));
  }
}

TEST_F(JsonText, BytesThatAreNoLettersAreReplaced) {
  const Json json{{"caf\xe9",
                   "\xff\xfe"
                   "a"}};
  EXPECT_EQ(to_text(json), "{\"caf\uFFFD\":\"\uFFFD\uFFFDa\"}");
  EXPECT_EQ(to_text(json, -1, true), R"({"caf\ufffd":"\ufffd\ufffda"})");
  EXPECT_EQ(valid_utf8("caf\xe9.png"), "caf\uFFFD.png");
  EXPECT_EQ(valid_utf8("é 木目.png"), "é 木目.png");
}

}  // namespace
}  // namespace gramloom
