#include "jobs/names.h"

#include <algorithm>
#include <array>

#include "io/toml_reader.h"

namespace gramloom {

void check_name(const std::string& name, std::size_t longest, const toml::source_region& region) {
  if (name.empty()) fail(region, "a name is empty");
  const bool unfit = std::any_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 32 || c == 127 ||
           std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
  });
  if (unfit || name.front() == '.' || name.front() == ' ' || name.back() == ' ')
    fail(region, "name '{}' is not fit for a file name", name);
  if (name.size() > longest)
    fail(region, "name is {} bytes long, allowed are {}", name.size(), longest);
}

std::string in_small_letters(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool is_own_file(const std::string& name, std::string_view word) {
  const std::string small = in_small_letters(name);
  if (!small.starts_with(word)) return false;
  constexpr std::array<std::string_view, 8> extensions{"",     ".json", ".csv", ".html",
                                                       ".png", ".exr",  ".tif", ".jpg"};
  return std::find(extensions.begin(), extensions.end(), small.substr(word.size())) !=
         extensions.end();
}

void NamesInUse::add(const std::string& name, const toml::source_region& region) {
  const auto [entry, is_new] = by_small_letters_.emplace(in_small_letters(name), name);
  if (is_new) return;
  if (entry->second == name) fail(region, "name '{}' is there twice", name);
  fail(region, "names '{}' and '{}' differ in capitals alone, which some disks don't tell apart",
       entry->second, name);
}

}  // namespace gramloom
