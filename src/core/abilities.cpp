#include "core/abilities.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace gramloom {

namespace {

constexpr int most_channels = 64;
constexpr float largest_value = 1e15f;  // sums of squares of whole images stay finite

void check_fits(std::string_view what, const Image& image, Size size) {
  if (image.empty() || image.size() == size) return;
  throw Error("{} has {}×{} pixels: {}×{} are needed", what, image.width, image.height, size.width,
              size.height);
}

void check_channels(std::string_view what, const Image& image, int channels) {
  if (image.empty() || image.channels == channels) return;
  throw Error("{} has {} channels: {} are needed", what, image.channels, channels);
}

bool any_above_half(const Image& mask) {
  return std::ranges::any_of(mask.pixels, [](float v) { return v > 0.5f; });
}

// A map of the target: of its size, or of 1×1 and then everywhere the same.
void check_map(std::string_view what, const Image& map, Size size, int channels) {
  if (map.size() != Size{1, 1}) check_fits(what, map, size);
  check_channels(what, map, channels);
  if (!std::ranges::all_of(map.pixels, [](float v) { return std::isfinite(v); }))
    throw Error("{} holds values that are not finite numbers", what);
}

void check_not_negative(std::string_view what, const Image& map) {
  if (std::ranges::any_of(map.pixels, [](float v) { return v < 0; }))
    throw Error("{} holds values below 0", what);
}

void check_weights(const Image& weights) {
  const auto channels = static_cast<std::size_t>(weights.channels);
  for (std::size_t i = 0; i < weights.pixels.size(); i += channels)
    if (std::all_of(weights.pixels.begin() + static_cast<std::ptrdiff_t>(i),
                    weights.pixels.begin() + static_cast<std::ptrdiff_t>(i + channels),
                    [](float v) { return v == 0; }))
      throw Error("the weights of all exemplars are 0 at ({}, {})",
                  i / channels % static_cast<std::size_t>(weights.width),
                  i / channels / static_cast<std::size_t>(weights.width));
}

void check_layers(const Exemplar& exemplar) {
  int next = 0;
  for (const Layer& layer : exemplar.layers) {
    if (layer.first != next || layer.count < 1)
      throw Error("the layer '{}' has {} channels from {} on: it must begin at {} and have one",
                  layer.name, layer.count, layer.first, next);
    if (layer.kind == MapKind::normal && layer.count != 3)
      throw Error("the layer '{}' is a normal of {} channels: it must have 3", layer.name,
                  layer.count);
    next += layer.count;
  }
  if (!exemplar.layers.empty() && next != exemplar.image.channels)
    throw Error("the layers have {} channels and the exemplar {}: they must be equal", next,
                exemplar.image.channels);
}

void check_exemplar(const Exemplar& exemplar, const Request& request) {
  const Exemplar& first = request.exemplars.front();
  check_picture(exemplar.image);
  check_channels("an exemplar", exemplar.image, first.image.channels);
  check_layers(exemplar);
  if (exemplar.layers != first.layers) throw Error("the exemplars have different layers");
  check_fits("an exemplar's mask", exemplar.mask, exemplar.image.size());
  check_channels("an exemplar's mask", exemplar.mask, 1);
  if (!exemplar.mask.empty() && !any_above_half(exemplar.mask))
    throw Error("an exemplar's mask is 0 everywhere: nothing of it may be used");
  check_fits("an exemplar's guide", exemplar.guide, exemplar.image.size());
  if (exemplar.guide.empty() != request.target.guide.empty())
    throw Error("exemplars and target must all have a guide, or none");
  check_channels("an exemplar's guide", exemplar.guide, request.target.guide.channels);
}

void check_target(const Target& target, const std::vector<Exemplar>& exemplars) {
  if (target.known.empty() != target.mask.empty())
    throw Error("a target has known pixels and a mask of what is to be made, or neither");
  check_fits("the target's known picture", target.known, target.size);
  if (!exemplars.empty())
    check_channels("the target's known picture", target.known, exemplars.front().image.channels);
  check_fits("the target's mask", target.mask, target.size);
  check_channels("the target's mask", target.mask, 1);
  if (!target.mask.empty() && !any_above_half(target.mask))
    throw Error("the target's mask is 0 everywhere: nothing is to be made");
  check_fits("the target's guide", target.guide, target.size);
  check_map("the guide's weight", target.guide_weight, target.size, 1);
  check_not_negative("the guide's weight", target.guide_weight);
  check_map("the weights", target.weights, target.size, static_cast<int>(exemplars.size()));
  check_not_negative("the weights", target.weights);
  check_weights(target.weights);
  check_map("the turn", target.turn, target.size, 2);
}

}  // namespace

std::optional<Lack> find_lack(std::string_view kind, Abilities abilities,
                              const RequestSize& request) {
  const auto count = request.exemplars.size();
  const auto any = [&](bool ExemplarSize::*has) {
    return std::ranges::any_of(request.exemplars, has);
  };
  const auto lacks = [&](Ability ability) { return !abilities.has(ability); };
  if (lacks(Ability::exemplar) && count > 0)
    return Lack{Ability::exemplar, fmt::format("{} takes no exemplar: {} given", kind,
                                               count == 1 ? "one is" : "several are")};
  if (lacks(Ability::exemplars) && count > 1)
    return Lack{Ability::exemplars,
                fmt::format("{} takes one exemplar: {} are given", kind, count)};
  if (lacks(Ability::mask) && any(&ExemplarSize::mask))
    return Lack{
        Ability::mask,
        fmt::format("{} cannot leave out parts of an exemplar: an exemplar's mask is given", kind)};
  if (lacks(Ability::guide) && (request.guide || any(&ExemplarSize::guide)))
    return Lack{Ability::guide, fmt::format("{} cannot follow a guide: a guide is given", kind)};
  if (lacks(Ability::mix) && request.weights)
    return Lack{Ability::mix, fmt::format("{} cannot mix exemplars: weights are given", kind)};
  if (lacks(Ability::turn) && request.turn)
    return Lack{Ability::turn,
                fmt::format("{} cannot turn or scale an exemplar: a turn is given", kind)};
  if (lacks(Ability::fill) && request.known)
    return Lack{Ability::fill, fmt::format("{} cannot fill: a target's mask is given", kind)};
  return std::nullopt;
}

void check_picture(const Image& exemplar) {
  if (exemplar.empty()) throw Error("the exemplar is empty");
  if (exemplar.channels > most_channels)
    throw Error("the exemplar has {} channels: allowed are 1 to {}", exemplar.channels,
                most_channels);
  if (!std::ranges::all_of(exemplar.pixels, [](float v) { return std::isfinite(v); }))
    throw Error("the exemplar holds values that are not finite numbers");
  if (std::ranges::any_of(exemplar.pixels, [](float v) { return std::abs(v) > largest_value; }))
    throw Error("the exemplar holds values beyond ±{:g}", largest_value);
}

void check_size(Size wanted) {
  if (wanted.width < 1 || wanted.height < 1)
    throw Error("size = [{}, {}]: both must be at least 1", wanted.width, wanted.height);
}

namespace detail {

void check_request(std::string_view kind, Abilities abilities, const RequestSize& request) {
  if (const auto lack = find_lack(kind, abilities, request)) throw Error("{}", lack->refusal);
  if (abilities.has(Ability::exemplar) && request.exemplars.empty())
    throw Error("{} needs an exemplar: none is given", kind);
  check_size(request.size);
}

void check_request(std::string_view kind, Abilities abilities, const Request& request) {
  check_request(kind, abilities, size_of(request));
  for (const Exemplar& exemplar : request.exemplars) check_exemplar(exemplar, request);
  check_target(request.target, request.exemplars);
}

}  // namespace detail

}  // namespace gramloom
