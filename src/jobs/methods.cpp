#include "jobs/methods.h"

#include "classic/known_pixels.h"
#include "core/variants.h"
#include "jobs/unit_normals.h"
#include "signal/blended_joins.h"
#include "signal/turned.h"

namespace gramloom {

namespace {

// The method's own refusal, and what to take instead.
void refuse_lacks(const Method& method, const RequestSize& request) {
  const auto lack = find_lack(kind_of(method), abilities_of(method), request);
  if (!lack) return;
  const auto others = methods_with(lack->ability);
  if (others.empty()) throw Error("{}; no method can yet", lack->refusal);
  throw Error("{}; methods that can: {}", lack->refusal, fmt::join(others, ", "));
}

// A texture with the maps that the exemplar has joined to its image, as methods of
// exemplars return it.
Texture joined_as(Texture texture, const Exemplar& exemplar) {
  std::vector<const Image*> parts{&texture.image};
  int channels = texture.image.channels;
  for (const Layer& layer : exemplar.layers) {
    if (layer.name.empty()) continue;
    const auto map = texture.maps.find(layer.name);
    if (map == texture.maps.end())
      throw Error("the exemplar has a map '{}' that the model has not", layer.name);
    if (parts.back() == &map->second) continue;  // a map's alpha
    parts.push_back(&map->second);
    channels += map->second.channels;
  }
  if (channels != exemplar.image.channels)
    throw Error("the model's picture and maps have {} channels, those of the exemplar {}", channels,
                exemplar.image.channels);
  if (parts.size() == 1) return texture;
  Texture joined;
  joined.image = Image(texture.image.size(), channels);
  float* to = joined.image.pixels.data();
  for (int y = 0; y < joined.image.height; ++y)
    for (int x = 0; x < joined.image.width; ++x)
      for (const Image* part : parts) to = std::copy_n(part->at(x, y), part->channels, to);
  return joined;
}

}  // namespace

std::string_view kind_of(const Method& method) {
  return std::visit([](const auto& params) { return std::decay_t<decltype(params)>::kind; },
                    method);
}

Abilities abilities_of(const Method& method) {
  return std::visit([](const auto& params) { return std::decay_t<decltype(params)>::abilities; },
                    method);
}

std::vector<std::string_view> methods_with(Ability ability) {
  std::vector<std::string_view> kinds;
  for_each_alternative<Method>([&]<class Params>(std::type_identity<Params>) {
    if (Params::abilities.has(ability)) kinds.push_back(Params::kind);
  });
  return kinds;
}

std::string compared_with(const Method& method) {
  return std::visit(
      []<class Params>(const Params& params) -> std::string {
        if constexpr (HasComparison<Params>) return params.exemplar;
        return "";
      },
      method);
}

Texture run_method(const Method& method, const Request& request, const Control& control) {
  if (!request.exemplars.empty() && !compared_with(method).empty()) {
    const Request without{{}, request.target, request.random};
    return joined_as(run_method(method, without, control), request.exemplars.front());
  }
  refuse_lacks(method, size_of(request));
  std::optional<Turned> turned;
  if (!request.target.turn.empty()) turned.emplace(request);
  const Request& asked = turned ? turned->request() : request;
  Texture texture =
      std::visit([&](const auto& params) { return synthesise(params, asked, control); }, method);
  blend_joins(texture, asked);
  keep_normals_unit(texture, asked.exemplars);
  if (turned) turned->name_sources(texture.source);
  keep_known(texture.image, request.target);  // bit for bit, whatever a method computes with
  return texture;
}

Cost estimate_method(const Method& method, const RequestSize& request) {
  if (!request.exemplars.empty() && !compared_with(method).empty()) {
    RequestSize without = request;
    without.exemplars.clear();
    return estimate_method(method, without);
  }
  refuse_lacks(method, request);
  const RequestSize asked = request.turn ? size_of_turned(request) : request;
  return std::visit([&](const auto& params) { return estimate(params, asked); }, method);
}

}  // namespace gramloom
