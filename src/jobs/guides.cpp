#include "jobs/guides.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/without_alpha.h"
#include "jobs/loaded_request.h"
#include "jobs/picture_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr int most_labels = 32;
/// Between two labels lies much more than between any two places of a picture.
constexpr float weight_of_labels = 10;

using Colour = std::vector<float>;
using Labels = std::map<Colour, int>;

Colour colour_at(const Image& guide, int x, int y) {
  return {guide.at(x, y), guide.at(x, y) + guide.channels};
}

std::string described(const Colour& colour) {
  std::string text;
  for (const float value : colour)
    text += fmt::format("{}{:g}", text.empty() ? "" : ", ", std::round(255 * value));
  return text;
}

// Numbers the guide's colours, where the mask lets be used what they are of; false when there are
// too many.
bool add_labels(const Image& guide, const Image& mask, Labels& labels) {
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x) {
      if (!mask.empty() && *mask.at(x, y) <= 0.5f) continue;
      labels.emplace(colour_at(guide, x, y), static_cast<int>(labels.size()));
      if (labels.size() > most_labels) return false;
    }
  return true;
}

// A channel for each label: 1 where the guide has it. What may not be used can have others.
Image one_hot(const Image& guide, const Labels& labels) {
  Image result(guide.size(), static_cast<int>(labels.size()));
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x) result.at(x, y)[labels.at(colour_at(guide, x, y))] = 1;
  return result;
}

struct NamedGuide {
  std::string file;
  Image* guide;
  const Image* mask;  // where there is one
};

void check_channels(const std::vector<NamedGuide>& exemplars, const NamedGuide& target,
                    const std::string& place) {
  for (const NamedGuide& exemplar : exemplars)
    if (exemplar.guide->channels != target.guide->channels)
      throw ConfigError(
          "{}: the guide {} has {} {} and that of the exemplar, {}, {}: they must be "
          "equal",
          place, target.file, target.guide->channels,
          target.guide->channels == 1 ? "channel" : "channels", exemplar.file,
          exemplar.guide->channels);
}

void check_known(const Labels& labels, const std::vector<NamedGuide>& exemplars,
                 const NamedGuide& target, const std::string& place) {
  const Image& guide = *target.guide;
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x) {
      const Colour colour = colour_at(guide, x, y);
      if (labels.contains(colour)) continue;
      throw ConfigError(
          "{}: the guide {} has the label ({}) at ({}, {}), which {} has not where it may be "
          "used{}",
          place, target.file, described(colour), x, y, exemplars.front().file,
          exemplars.size() > 1 ? ", nor the other exemplars' guides" : "");
    }
}

// Whether guides are labels; then `labels` are those of the exemplars.
bool are_labels(GuideKind kind, const std::vector<NamedGuide>& exemplars, const NamedGuide& target,
                const std::string& place, Labels& labels) {
  if (kind == GuideKind::values) return false;
  bool few = true;
  for (const NamedGuide& exemplar : exemplars)
    few = few && add_labels(*exemplar.guide, *exemplar.mask, labels);
  Labels all = labels;
  few = few && add_labels(*target.guide, *target.mask, all);
  if (!few && kind == GuideKind::labels)
    throw ConfigError(
        "{}: the guides have more than {} colours: labels must be painted without smooth edges and "
        "kept in a format that loses nothing",
        place, most_labels);
  return few;
}

// All guides with the exemplars' total variance as 1.
void standardise(const std::vector<NamedGuide>& exemplars, const NamedGuide& target) {
  const auto channels = static_cast<std::size_t>(target.guide->channels);
  std::vector<double> sums(channels), squares(channels);
  double count = 0;
  for (const NamedGuide& exemplar : exemplars) {
    const std::vector<float>& values = exemplar.guide->pixels;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sums[i % channels] += static_cast<double>(values[i]);
      squares[i % channels] += static_cast<double>(values[i]) * static_cast<double>(values[i]);
    }
    count += static_cast<double>(values.size() / channels);
  }
  double variance = 0;
  for (std::size_t c = 0; c < channels; ++c)
    variance += squares[c] / count - sums[c] * sums[c] / (count * count);
  if (variance <= 0) return;
  const auto scale = static_cast<float>(1 / std::sqrt(variance));
  const auto scaled = [&](Image& guide) {
    for (float& value : guide.pixels) value *= scale;
  };
  for (const NamedGuide& exemplar : exemplars) scaled(*exemplar.guide);
  scaled(*target.guide);
}

Image weight_of(const GuideEntry& guide, Size size, float most, const std::string& place) {
  if (guide.weight_image.empty()) return {1, 1, 1, most};
  Image weight =
      brightness(read_sized(guide.weight_image, size, "the guide's weight", "the texture", place));
  for (float& value : weight.pixels) value *= most;
  return weight;
}

}  // namespace

void add_guides(const Config& config, const std::vector<fs::path>& files,
                std::vector<Exemplar>& exemplars, Target& target) {
  const GuideEntry& guide = *config.direction.guide;
  const std::string place = place_of(config, "guide");
  target.guide =
      without_alpha(read_sized(guide.image, target.size, "the guide", "the texture", place));
  std::vector<NamedGuide> guides;
  for (std::size_t i = 0; i < exemplars.size(); ++i)
    guides.push_back({files[i].string(), &exemplars[i].guide, &exemplars[i].mask});
  const Image everywhere;
  const NamedGuide asked{guide.image.string(), &target.guide, &everywhere};
  check_channels(guides, asked, place);
  Labels labels;
  float weight = static_cast<float>(guide.weight);
  if (are_labels(guide.kind, guides, asked, place, labels)) {
    check_known(labels, guides, asked, place);
    for (Exemplar& exemplar : exemplars) exemplar.guide = one_hot(exemplar.guide, labels);
    target.guide = one_hot(target.guide, labels);
    weight *= weight_of_labels;
  } else {
    standardise(guides, asked);
  }
  target.guide_weight = weight_of(guide, target.size, weight, place);
}

}  // namespace gramloom
