#include "runs/samples.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace gramloom {

namespace {

namespace fs = std::filesystem;

std::optional<Sample> sample_of(const fs::path& file, const std::string& name) {
  const std::string stem = file.stem().string();
  if (file.extension() != ".png" || !stem.starts_with(name + "_")) return std::nullopt;
  const std::string what = stem.substr(name.size() + 1);
  if (what == "held_out") return Sample{file, std::nullopt};
  int step = 0;
  const auto [end, error] = std::from_chars(what.data(), what.data() + what.size(), step);
  if (what.size() < 6 || what.front() == '-' || error != std::errc() ||
      end != what.data() + what.size())
    return std::nullopt;
  return Sample{file, step};
}

}  // namespace

std::vector<Sample> samples_in(const fs::path& folder, const std::string& name) {
  std::vector<Sample> samples;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (auto sample = sample_of(entry.path(), name)) samples.push_back(std::move(*sample));
  std::ranges::sort(samples, {}, [](const Sample& sample) {
    return std::pair(sample.step.value_or(std::numeric_limits<int>::max()), sample.file);
  });
  return samples;
}

}  // namespace gramloom
