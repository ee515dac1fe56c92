#include "io/safetensors.h"

#include <Imath/half.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <tuple>

#include "core/error.h"
#include "io/json_text.h"
#include "io/regular_file.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using SortedJson = nlohmann::json;  // and quick to search among thousands of names

static_assert(std::endian::native == std::endian::little, "safetensors files are little-endian");

constexpr std::uint64_t length_bytes = 8;
constexpr std::uint64_t longest_header = 100'000'000;  // as the reference implementation
constexpr const char* metadata_key = "__metadata__";

/// What the header says of one tensor; begin and end count bytes after the header.
struct Entry {
  std::string name;
  std::string dtype;
  std::vector<std::int64_t> shape;
  std::uint64_t count = 1;  // of values
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

struct Header {
  std::vector<Entry> entries;     // in the order of their data
  SortedJson metadata;            // null: none
  std::uint64_t data_offset = 0;  // of the file
};

std::optional<std::uint64_t> bytes_of(const std::string& dtype) {
  static const std::map<std::string, std::uint64_t> bytes{
      {"BOOL", 1}, {"U8", 1},  {"I8", 1},  {"F8_E4M3", 1}, {"F8_E5M2", 1},
      {"U16", 2},  {"I16", 2}, {"F16", 2}, {"BF16", 2},    {"U32", 4},
      {"I32", 4},  {"F32", 4}, {"U64", 8}, {"I64", 8},     {"F64", 8}};
  const auto found = bytes.find(dtype);
  return found == bytes.end() ? std::nullopt : std::optional(found->second);
}

/// One tensor's part of the header; its Errors lack the path.
Entry parse_entry(const std::string& name, const SortedJson& json) {
  Entry entry;
  entry.name = name;
  const auto field = [&](const char* key) -> const SortedJson& {
    if (!json.is_object() || !json.contains(key)) throw Error("tensor '{}' has no {}", name, key);
    return json[key];
  };
  if (!field("dtype").is_string()) throw Error("tensor '{}': the dtype is not a text", name);
  entry.dtype = field("dtype").get<std::string>();

  if (!field("shape").is_array()) throw Error("tensor '{}': the shape is not a list", name);
  for (const SortedJson& side : field("shape")) {
    // A number above 2^63 - 1 is unsigned for the JSON reader.
    if (!side.is_number_integer() || (side.is_number_unsigned() && side > INT64_MAX) || side < 0)
      throw Error("tensor '{}': {} is not a length in the shape", name, to_text(side));
    entry.shape.push_back(side.get<std::int64_t>());
    if (__builtin_mul_overflow(entry.count, side.get<std::uint64_t>(), &entry.count))
      throw Error("tensor '{}': the shape is too large", name);
  }

  const SortedJson& offsets = field("data_offsets");
  if (!offsets.is_array() || offsets.size() != 2 || !offsets[0].is_number_unsigned() ||
      !offsets[1].is_number_unsigned())
    throw Error("tensor '{}': data_offsets are not two positions", name);
  entry.begin = offsets[0].get<std::uint64_t>();
  entry.end = offsets[1].get<std::uint64_t>();
  if (entry.begin > entry.end)
    throw Error("tensor '{}' ends at byte {}, before it begins at {}", name, entry.end,
                entry.begin);
  return entry;
}

/// The offsets of all entries (sorted) must cover the data exactly, as the format demands.
void check_offsets(const std::vector<Entry>& entries, std::uint64_t data_bytes) {
  std::uint64_t covered = 0;
  for (const Entry& entry : entries) {
    if (entry.end > data_bytes)
      throw Error("tensor '{}' ends at byte {} of {}: the file is truncated or damaged", entry.name,
                  entry.end, data_bytes);
    if (entry.begin < covered) throw Error("tensor '{}' overlaps another one", entry.name);
    if (entry.begin > covered)
      throw Error("no tensor owns the {} bytes before '{}'", entry.begin - covered, entry.name);
    covered = entry.end;
    std::uint64_t bytes = 0;
    const auto value_bytes = bytes_of(entry.dtype);
    // A dtype that we don't know matters only to those who want that tensor.
    if (value_bytes && (__builtin_mul_overflow(entry.count, *value_bytes, &bytes) ||
                        bytes != entry.end - entry.begin))
      throw Error("tensor '{}' has {} bytes, which is not its shape in {}", entry.name,
                  entry.end - entry.begin, entry.dtype);
  }
  if (covered != data_bytes)
    throw Error("{} bytes after the last tensor belong to none", data_bytes - covered);
}

SortedJson parse_header(const std::string& text) {
  std::set<std::string> names;
  std::string duplicate;
  const auto watch = [&](int depth, SortedJson::parse_event_t event, SortedJson& parsed) {
    if (event == SortedJson::parse_event_t::key && depth == 1 &&
        !names.insert(parsed.get<std::string>()).second)
      duplicate = parsed.get<std::string>();
    return true;
  };
  SortedJson json;
  try {
    json = parse_json<SortedJson>(text, watch);
  } catch (const Error& error) {
    throw Error("the header is not valid JSON: {}", error.what());
  }
  if (!json.is_object()) throw Error("the header is not a JSON object");
  if (!duplicate.empty()) throw Error("two tensors are called '{}'", duplicate);
  return json;
}

Header read_header(std::ifstream& file, std::uint64_t file_bytes) {
  std::uint64_t length = 0;
  if (file_bytes < length_bytes) throw Error("truncated: {} bytes are no header", file_bytes);
  file.read(reinterpret_cast<char*>(&length), length_bytes);
  if (!file || length < 2 || length > longest_header || length > file_bytes - length_bytes)
    throw Error("a header of {} bytes in a file of {}: truncated, or not a safetensors file",
                length, file_bytes);
  std::string text(length, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(length)))
    throw Error("the header cannot be read");

  Header header{.entries = {}, .metadata = {}, .data_offset = length_bytes + length};
  const SortedJson json = parse_header(text);
  for (const auto& [name, value] : json.items())
    if (name == metadata_key)
      header.metadata = value;
    else
      header.entries.push_back(parse_entry(name, value));
  std::sort(header.entries.begin(), header.entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.begin, a.end, a.name) < std::tie(b.begin, b.end, b.name);
  });
  check_offsets(header.entries, file_bytes - header.data_offset);
  return header;
}

/// `bytes` as values of type Stored, each made a float by `convert`.
template <class Stored, class Convert>
std::vector<float> convert_all(const std::vector<char>& bytes, Convert convert) {
  std::vector<float> values(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Stored stored;
    std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    values[i] = convert(stored);
  }
  return values;
}

std::vector<float> to_floats(const Entry& entry, const std::vector<char>& bytes) {
  if (entry.dtype == "F32") return convert_all<float>(bytes, [](float value) { return value; });
  if (entry.dtype == "F64")
    return convert_all<double>(bytes, [](double value) { return static_cast<float>(value); });
  if (entry.dtype == "F16")
    return convert_all<std::uint16_t>(bytes,
                                      [](std::uint16_t b) { return imath_half_to_float(b); });
  if (entry.dtype == "BF16")  // the upper half of a float
    return convert_all<std::uint16_t>(bytes, [](std::uint16_t bits) {
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16);
    });
  throw Error("tensor '{}' is of dtype {}; F16, BF16, F32 and F64 can be read", entry.name,
              entry.dtype);
}

TensorData read_tensor(std::ifstream& file, const Header& header, const Entry& entry) {
  std::vector<char> bytes(entry.end - entry.begin);
  file.seekg(static_cast<std::streamoff>(header.data_offset + entry.begin));
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw Error("tensor '{}' cannot be read", entry.name);
  return {entry.shape, to_floats(entry, bytes)};
}

// f(file, header), with the path in front of errors.
template <class F>
auto read_file(const fs::path& path, F&& f) {
  try {
    const RegularFile regular(path);
    std::ifstream file(regular.name(), std::ios::binary);
    if (!file) throw Error("cannot read: {}", std::strerror(errno));
    return f(file, read_header(file, regular.size()));
  } catch (const Error& error) {
    throw Error("{}: {}", path.string(), error.what());
  }
}

}  // namespace

std::map<std::string, TensorData> read_tensors(const fs::path& path, const WantsTensor& wants) {
  return read_file(path, [&](std::ifstream& file, const Header& header) {
    std::map<std::string, TensorData> tensors;
    for (const Entry& entry : header.entries)
      if (!wants || wants(entry.name)) tensors[entry.name] = read_tensor(file, header, entry);
    return tensors;
  });
}

std::map<std::string, std::string> read_metadata(const fs::path& path) {
  return read_file(path, [](std::ifstream&, const Header& header) {
    std::map<std::string, std::string> texts;
    if (header.metadata.is_null()) return texts;
    if (!header.metadata.is_object()) throw Error("the metadata are not texts by name");
    for (const auto& [name, value] : header.metadata.items()) {
      if (!value.is_string()) throw Error("the metadata's '{}' is not a text", name);
      texts[name] = value.get<std::string>();
    }
    return texts;
  });
}

void write_tensors(const fs::path& path, const std::map<std::string, TensorData>& tensors,
                   const std::map<std::string, std::string>& metadata) {
  SortedJson header = SortedJson::object();
  if (!metadata.empty()) header[metadata_key] = metadata;
  std::size_t end = 0;
  for (const auto& [name, tensor] : tensors) {
    std::int64_t count = 1;
    for (const std::int64_t side : tensor.shape)
      if (side < 0 || __builtin_mul_overflow(count, side, &count)) count = -1;
    if (count < 0 || static_cast<std::uint64_t>(count) != tensor.values.size())
      throw Error("{}: tensor '{}' has {} values, which is not its shape", path.string(), name,
                  tensor.values.size());
    const std::size_t begin = end;
    end += tensor.values.size() * sizeof(float);
    header[name] = {{"dtype", "F32"}, {"shape", tensor.shape}, {"data_offsets", {begin, end}}};
  }
  std::string text = to_text(header);
  text.resize((text.size() + 7) / 8 * 8, ' ');  // the format's padding: the data begins aligned
  const std::uint64_t length = text.size();
  std::string file;  // at once of its size: a large picture's checkpoint takes gigabytes
  file.reserve(sizeof length + text.size() + end);
  file.append(reinterpret_cast<const char*>(&length), sizeof length).append(text);
  for (const auto& [name, tensor] : tensors)
    file.append(reinterpret_cast<const char*>(tensor.values.data()),
                tensor.values.size() * sizeof(float));
  write_text(path, file);
}

}  // namespace gramloom
