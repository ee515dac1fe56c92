#include "learnt/generator_model.h"

#include <set>

#include "core/error.h"
#include "learnt/model_file.h"

namespace gramloom {

namespace {

using Shapes = std::map<std::string, std::vector<std::int64_t>>;

void add_level(const GeneratorDescription& description, int k, Shapes& shapes) {
  const GeneratorLevel& level = description.levels[static_cast<std::size_t>(k)];
  const std::string name = fmt::format("levels.{}.", k);
  const auto materials = static_cast<std::int64_t>(description.materials.size());
  for (int i = 0; i < level.layers; ++i) {
    const int inputs = i == 0 ? inputs_of(description, k) : level.hidden;
    shapes[fmt::format("{}layers.{}.weight", name, i)] = {level.hidden, inputs, 3, 3};
    shapes[fmt::format("{}layers.{}.bias", name, i)] = {level.hidden};
    if (materials == 1) continue;
    shapes[fmt::format("{}scales.{}", name, i)] = {materials, level.hidden};
    shapes[fmt::format("{}shifts.{}", name, i)] = {materials, level.hidden};
  }
  shapes[name + "out.weight"] = {description.channels, level.hidden, 1, 1};
  shapes[name + "out.bias"] = {description.channels};
  if (materials > 1) shapes[name + "out_shifts"] = {materials, description.channels};
}

// Throws Error for a description that no generator has.
void check_description(const GeneratorDescription& description, const std::string& file) {
  const auto fail = [&](const std::string& why) { throw Error("{}: {}", file, why); };
  if (description.levels.empty() || description.levels.size() > 8)
    fail("a generator has 1 to 8 levels");
  if (description.materials.empty() || description.materials.size() > 8)
    fail("a generator has 1 to 8 materials");
  for (const GeneratorLevel& level : description.levels)
    if (level.noise % 4 != 0) fail("its channels of noise are no multiple of 4");
  int channels = 0;
  std::set<std::string> names;
  const std::string* before = nullptr;
  for (const GeneratorLayer& layer : description.layers) {
    const bool alpha = before && *before == layer.name && layer.kind == MapKind::alpha;
    if ((!alpha && !names.insert(layer.name).second) || layer.name.empty() != (names.size() == 1) ||
        layer.name.find_first_of("/\\") != std::string::npos)
      fail("its layers have names that no maps have");
    before = &layer.name;
    if (layer.first != channels) fail("its layers leave a gap");
    channels += layer.count;
  }
  if (channels != description.channels) fail("its layers are not all its channels");
}

}  // namespace

std::vector<GeneratorPart> parts_of(const std::vector<GeneratorLayer>& layers) {
  std::vector<GeneratorPart> parts;
  for (const GeneratorLayer& layer : layers) {
    if (parts.empty() || parts.back().name != layer.name)
      parts.push_back({layer.name, layer.kind, layer.first, 0});
    parts.back().count += layer.count;
  }
  return parts;
}

int inputs_of(const GeneratorDescription& description, int level) {
  return description.levels[static_cast<std::size_t>(level)].noise +
         (level == 0 ? 0 : description.channels);
}

Shapes tensor_shapes(const GeneratorDescription& description) {
  Shapes shapes;
  for (int k = 0; k < static_cast<int>(description.levels.size()); ++k)
    add_level(description, k, shapes);
  for (const char* name : {"colours.mean", "colours.low", "colours.high"})
    shapes[name] = {description.channels};
  shapes["colours.axes"] = {description.channels, description.channels};
  return shapes;
}

double multiplications_per_pixel(const GeneratorDescription& description) {
  double sum = 0;
  double share = 1;  // of pixels that the level has
  for (int k = static_cast<int>(description.levels.size()) - 1; k >= 0; --k, share /= 4) {
    const GeneratorLevel& level = description.levels[static_cast<std::size_t>(k)];
    const double inner = 9.0 * level.hidden * level.hidden * (level.layers - 1);
    sum += share * (9.0 * inputs_of(description, k) * level.hidden + inner +
                    1.0 * level.hidden * description.channels);
  }
  return sum;
}

GeneratorDescription read_generator_description(const std::filesystem::path& file) {
  auto description = read_description<GeneratorDescription>(file, "generator");
  check_description(description, file.string());
  return description;
}

GeneratorModel read_generator(const std::filesystem::path& file) {
  GeneratorModel model{read_generator_description(file), read_tensors(file)};
  check_tensors(model.tensors, tensor_shapes(model.description), file.string());
  const auto &low = model.values("colours.low"), &high = model.values("colours.high");
  for (std::size_t c = 0; c < low.size(); ++c)
    if (low[c] > high[c]) throw Error("{}: 'colours.low' is above 'colours.high'", file.string());
  return model;
}

void write_generator(const std::filesystem::path& file, const GeneratorModel& model,
                     const std::map<std::string, std::string>& more) {
  auto metadata = described(model.description);
  metadata.insert(more.begin(), more.end());
  write_tensors(file, model.tensors, metadata);
}

}  // namespace gramloom
