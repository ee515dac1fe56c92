#include "learnt/plain_generator.h"

#include <fmt/format.h>

#include <cmath>

namespace gramloom {

namespace {

class Folder {
 public:
  Folder(const GeneratorModel& model, std::span<const float> shares)
      : model_(model), shares_(shares) {}

  PlainLevel level(int k) const {
    const GeneratorDescription& description = model_.description;
    const GeneratorLevel& shape = description.levels[static_cast<std::size_t>(k)];
    const std::string name = fmt::format("levels.{}.", k);
    PlainLevel level{shape.noise, {}, {}};
    for (int i = 0; i < shape.layers; ++i) {
      PlainLayer layer{i == 0 ? inputs_of(description, k) : shape.hidden, shape.hidden, 3,
                       model_.values(fmt::format("{}layers.{}.weight", name, i)),
                       model_.values(fmt::format("{}layers.{}.bias", name, i))};
      const std::size_t count = layer.weights.size() / layer.bias.size();
      for (std::size_t c = 0; c < layer.bias.size(); ++c) {
        const float factor = 1 + mixed(fmt::format("{}scales.{}", name, i), layer.bias.size(), c);
        for (std::size_t j = 0; j < count; ++j) layer.weights[c * count + j] *= factor;
        const float shift = mixed(fmt::format("{}shifts.{}", name, i), layer.bias.size(), c);
        layer.bias[c] = residual_scale(i) * (factor * layer.bias[c] + shift);
      }
      level.layers.push_back(std::move(layer));
    }
    level.out = {shape.hidden, description.channels, 1, model_.values(name + "out.weight"),
                 model_.values(name + "out.bias")};
    for (float& weight : level.out.weights) weight /= residual_scale(shape.layers);
    for (std::size_t c = 0; c < level.out.bias.size(); ++c)
      level.out.bias[c] += mixed(name + "out_shifts", level.out.bias.size(), c);
    return level;
  }

 private:
  // The materials' values of a channel, by their shares; 0 where there is one material.
  float mixed(const std::string& tensor, std::size_t channels, std::size_t channel) const {
    if (model_.material_count() == 1 || shares_.empty()) return 0;
    const std::vector<float>& values = model_.values(tensor);
    float sum = 0;
    for (std::size_t m = 0; m < shares_.size(); ++m)
      sum += shares_[m] * values[m * channels + channel];
    return sum;
  }

  const GeneratorModel& model_;
  std::span<const float> shares_;
};

// The materials that have a share: "pebbles", "grass .7, gravel .3".
std::string title_of(const GeneratorDescription& description, std::span<const float> shares) {
  std::string title;
  for (std::size_t m = 0; m < shares.size(); ++m) {
    if (shares[m] <= 0) continue;
    if (!title.empty()) title += ", ";
    title += description.materials[m].name;
    if (shares[m] < 1) title += fmt::format(" {:.3g}", shares[m]);
  }
  return title;
}

std::string licence_of(const GeneratorDescription& description, std::span<const float> shares) {
  std::string licence;
  for (std::size_t m = 0; m < shares.size(); ++m) {
    const std::string& own = description.materials[m].licence;
    if (shares[m] <= 0 || own.empty() || licence.find(own) != std::string::npos) continue;
    licence += (licence.empty() ? "" : "; ") + own;
  }
  return licence;
}

}  // namespace

std::size_t PlainGenerator::weight_count() const {
  std::size_t count = 0;
  for (const PlainLevel& level : levels) {
    for (const PlainLayer& layer : level.layers) count += layer.weights.size() + layer.bias.size();
    count += level.out.weights.size() + level.out.bias.size();
  }
  return count;
}

float residual_scale(int layer) {
  float scale = 1;
  for (int i = 1; i < layer; ++i) scale *= 1.41421356f;  // √2
  return scale;
}

PlainLevel plain_level(const GeneratorModel& model, int level, std::span<const float> shares) {
  return Folder(model, shares).level(level);
}

PlainGenerator plain_generator(const GeneratorModel& model, std::span<const float> shares) {
  const GeneratorDescription& description = model.description;
  PlainGenerator plain{description.channels,
                       {},
                       model.values("colours.mean"),
                       model.values("colours.axes"),
                       model.values("colours.low"),
                       model.values("colours.high"),
                       title_of(description, shares),
                       licence_of(description, shares),
                       description.layers};
  for (int k = 0; k < model.level_count(); ++k)
    plain.levels.push_back(plain_level(model, k, shares));
  return plain;
}

std::string channel_names(const PlainGenerator& generator) {
  std::string names;
  for (const GeneratorLayer& layer : generator.picture_layers) {
    if (!names.empty()) names += ", ";
    names += fmt::format("{}", layer.first);
    if (layer.count > 1) names += fmt::format(" to {}", layer.first + layer.count - 1);
    const std::string_view kind = to_word(layer.kind);
    names +=
        layer.name.empty() ? fmt::format(" {}", kind) : fmt::format(" {} ({})", layer.name, kind);
  }
  return names;
}

std::string comment_text(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\\' || c == '?') c = ' ';
  for (std::size_t at = 0; (at = text.find("*/", at)) != std::string::npos;) text[at] = ' ';
  for (std::size_t at = 0; (at = text.find("/*", at)) != std::string::npos;) text[at] = ' ';
  return text;
}

std::string float_constant(float value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  if (const std::size_t zero = text.find("0."); zero == (text[0] == '-' ? 1 : 0) && text != "0.0")
    text.erase(zero, 1);
  return text;
}

}  // namespace gramloom
