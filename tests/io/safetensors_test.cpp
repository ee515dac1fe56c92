#include "io/safetensors.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "io/temp_folder.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using Tensors = std::map<std::string, TensorData>;

class Safetensors : public TempFolder {
 protected:
  /// A file with this header, its true length unless another is claimed, and `data`.
  std::filesystem::path file(const std::string& header, const std::string& data,
                             std::optional<std::uint64_t> claimed = {}) {
    const std::uint64_t length = claimed.value_or(header.size());
    write_text(path("a.safetensors"),
               std::string(reinterpret_cast<const char*>(&length), 8) + header + data);
    return path("a.safetensors");
  }
  std::string error(const std::string& header, std::size_t data_bytes,
                    std::optional<std::uint64_t> claimed = {}) {
    const auto name = file(header, std::string(data_bytes, '\0'), claimed);
    const std::string text = error_of([&] { read_tensors(name); });
    EXPECT_EQ(text.find(name.string() + ": "), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
};

std::string entry(const std::string& dtype, const std::string& shape, const std::string& offsets) {
  return R"({"dtype":")" + dtype + R"(","shape":)" + shape + R"(,"data_offsets":)" + offsets + "}";
}

template <class T>
std::string bytes(std::initializer_list<T> values) {
  std::string result(values.size() * sizeof(T), '\0');
  std::memcpy(result.data(), std::data(values), result.size());
  return result;
}

TEST_F(Safetensors, RoundTrip) {
  const Tensors tensors{{"features.0.weight", {{2, 3, 1, 1}, {0, -1, 2.5f, 1e-40f, 3e38f, 5}}},
                        {"features.0.bias", {{2}, {7, 8}}},
                        {"number", {{}, {4}}},
                        {"nothing", {{3, 0}, {}}},
                        {"ünïcode \"name\"", {{1}, {6}}}};
  write_tensors(path("a"), tensors, {{"source", "a text"}});
  EXPECT_EQ(read_tensors(path("a")), tensors);
  EXPECT_EQ(read_metadata(path("a")), (std::map<std::string, std::string>{{"source", "a text"}}));
  EXPECT_THAT(read_text(path("a")), HasSubstr(R"("__metadata__":{"source":"a text"})"));

  write_tensors(path("b"), tensors, {{"source", "a text"}});
  EXPECT_EQ(read_text(path("a")), read_text(path("b")));
  write_tensors(path("empty"), {});
  EXPECT_EQ(read_tensors(path("empty")), Tensors{});
  EXPECT_TRUE(read_metadata(path("empty")).empty());
}

TEST_F(Safetensors, EveryFloatType) {
  const auto f16 = bytes<std::uint16_t>({0x3c00, 0xc000, 0x0001, 0x7bff, 0x7c00});
  const auto bf16 = bytes<std::uint16_t>({0x3f80, 0xc000, 0x4049});
  const auto f64 = bytes<double>({0.1, -2.0});
  const auto name = file("{\"half\":" + entry("F16", "[5]", "[0,10]") +
                             ",\"brain\":" + entry("BF16", "[3]", "[10,16]") +
                             ",\"double\":" + entry("F64", "[2]", "[16,32]") + "}",
                         f16 + bf16 + f64);
  const auto tensors = read_tensors(name);
  EXPECT_EQ(tensors.at("half").values,
            (std::vector<float>{1, -2, std::ldexp(1.0f, -24), 65504,
                                std::numeric_limits<float>::infinity()}));
  EXPECT_EQ(tensors.at("brain").values, (std::vector<float>{1, -2, 3.140625f}));
  EXPECT_EQ(tensors.at("double").values, (std::vector<float>{0.1f, -2}));
}

TEST_F(Safetensors, OtherTypesMatterOnlyWhenWanted) {
  const auto name = file("{\"steps\":" + entry("I64", "[1]", "[0,8]") +
                             ",\"odd\":" + entry("F4_X", "[2]", "[8,9]") +
                             ",\"weight\":" + entry("F32", "[1]", "[9,13]") + "}",
                         std::string(9, '\0') + bytes<float>({3.0f}));
  EXPECT_EQ(read_tensors(name, [](const std::string& n) { return n == "weight"; }),
            (Tensors{{"weight", {{1}, {3}}}}));
  EXPECT_EQ(error_of([&] { read_tensors(name, [](const auto& n) { return n == "steps"; }); }),
            name.string() + ": tensor 'steps' is of dtype I64; F16, BF16, F32 and F64 can be read");
  EXPECT_THAT(error_of([&] { read_tensors(name, [](const auto& n) { return n == "odd"; }); }),
              HasSubstr("'odd' is of dtype F4_X"));
}

TEST_F(Safetensors, TruncatedAnywhere) {
  write_tensors(path("whole"), {{"a", {{3}, {1, 2, 3}}}, {"b", {{1, 2}, {4, 5}}}});
  const std::string whole = read_text(path("whole"));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_text(path("part"), whole.substr(0, length));
    EXPECT_NE(error_of([&] { read_tensors(path("part")); }), "") << length;
  }
  write_text(path("part"), whole + "x");
  EXPECT_THAT(error_of([&] { read_tensors(path("part")); }), HasSubstr("1 bytes after the last"));
}

TEST_F(Safetensors, HeaderLengthsThatLie) {
  const std::string header = "{\"a\":" + entry("F32", "[1]", "[0,4]") + "}";
  for (const std::uint64_t length :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{header.size() + 5},
        std::uint64_t{1} << 31, std::uint64_t{1} << 63, ~std::uint64_t{0}})
    EXPECT_THAT(error(header, 4, length),
                HasSubstr(fmt::format("a header of {} bytes in a file of ", length)));
  EXPECT_THAT(error(header, 4, header.size() - 1), HasSubstr("not valid JSON"));
  EXPECT_THAT(error(header, 4, header.size() + 4), HasSubstr("truncated or damaged"));
}

TEST_F(Safetensors, BrokenHeaders) {
  EXPECT_THAT(error("{\"a\":", 0), HasSubstr("not valid JSON"));
  EXPECT_THAT(error("{\"\xff\":1}", 0), HasSubstr("not valid JSON"));
  EXPECT_THAT(error(std::string(200'000, '['), 0), HasSubstr("not valid JSON"));
  EXPECT_THAT(error("[1]", 0), HasSubstr("not a JSON object"));
  EXPECT_THAT(error("{\"a\":7}", 0), HasSubstr("tensor 'a' has no dtype"));
  EXPECT_THAT(error(R"({"a":{"dtype":"F32","data_offsets":[0,0]}})", 0), HasSubstr("has no shape"));
  EXPECT_THAT(error(R"({"a":{"dtype":"F32","shape":[0]}})", 0), HasSubstr("has no data_offsets"));
  EXPECT_THAT(error(R"({"a":{"dtype":4,"shape":[0],"data_offsets":[0,0]}})", 0),
              HasSubstr("the dtype is not a text"));
  const std::string one = entry("F32", "[1]", "[0,4]");
  EXPECT_THAT(error("{\"a\":" + one + ",\"a\":" + one + "}", 4),
              HasSubstr("two tensors are called 'a'"));
  const auto metadata_error = [&](const std::string& metadata) {
    const auto name = file("{\"__metadata__\":" + metadata + "}", "");
    return error_of([&] { read_metadata(name); });
  };
  EXPECT_THAT(metadata_error("7"), HasSubstr("the metadata are not texts by name"));
  EXPECT_THAT(metadata_error("{\"a\":1}"), HasSubstr("the metadata's 'a' is not a text"));
}

TEST_F(Safetensors, BrokenShapes) {
  const auto shape_error = [&](const std::string& shape) {
    return error("{\"a\":" + entry("F32", shape, "[0,4]") + "}", 4);
  };
  EXPECT_THAT(shape_error("7"), HasSubstr("the shape is not a list"));
  EXPECT_THAT(shape_error("[-1]"), HasSubstr("-1 is not a length"));
  EXPECT_THAT(shape_error("[1.0]"), HasSubstr("1.0 is not a length"));
  EXPECT_THAT(shape_error("[\"1\"]"), HasSubstr("is not a length"));
  EXPECT_THAT(shape_error("[18446744073709551615]"), HasSubstr("is not a length"));
  EXPECT_THAT(shape_error("[4294967296,4294967296]"), HasSubstr("the shape is too large"));
  EXPECT_THAT(shape_error("[4611686018427387905]"), HasSubstr("not its shape in F32"));
  EXPECT_THAT(shape_error("[2]"), HasSubstr("'a' has 4 bytes, which is not its shape in F32"));
}

TEST_F(Safetensors, BrokenOffsets) {
  const auto offset_error = [&](const std::string& a, const std::string& b) {
    return error("{\"a\":" + entry("F32", "[1]", a) + ",\"b\":" + entry("F32", "[1]", b) + "}", 8);
  };
  EXPECT_THAT(offset_error("[0,4]", "[4,12]"), HasSubstr("'b' ends at byte 12 of 8"));
  EXPECT_THAT(offset_error("[0,4]", "[0,4]"), HasSubstr("overlaps"));
  EXPECT_THAT(offset_error("[0,4]", "[2,6]"), HasSubstr("'b' overlaps"));
  EXPECT_THAT(offset_error("[0,4]", "[8,4]"), HasSubstr("ends at byte 4, before it begins at 8"));
  EXPECT_THAT(offset_error("[0,4]", "[5,8]"), HasSubstr("1 bytes before 'b'"));
  EXPECT_THAT(offset_error("[-4,4]", "[4,8]"), HasSubstr("not two positions"));
  EXPECT_THAT(offset_error("[0]", "[4,8]"), HasSubstr("not two positions"));
  EXPECT_THAT(offset_error("[0,18446744073709551616]", "[4,8]"), HasSubstr("not two positions"));
  EXPECT_THAT(offset_error("[18446744073709551612,18446744073709551615]", "[0,4]"),
              HasSubstr("of 8"));
}

TEST_F(Safetensors, MissingFilesAndWrongValues) {
  EXPECT_EQ(error_of([&] { read_tensors(path("none")); }),
            path("none").string() + ": cannot read: No such file or directory");
  EXPECT_THAT(error_of([&] { read_tensors(path()); }), HasSubstr("cannot read: Is a directory"));
  EXPECT_THAT(error_of([&] {
                write_tensors(path("a"), {{"t", {{2}, {1}}}});
              }),
              HasSubstr("tensor 't' has 1 values, which is not its shape"));
  EXPECT_THAT(error_of([&] {
                write_tensors(path("a"), {{"t", {{-1, -1}, {1}}}});
              }),
              HasSubstr("not its shape"));
  EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace gramloom
