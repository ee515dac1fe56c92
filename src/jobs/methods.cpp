#include "jobs/methods.h"

#include "classic/known_pixels.h"
#include "core/variants.h"
#include "jobs/unit_normals.h"
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

Texture run_method(const Method& method, const Request& request, const Control& control) {
  refuse_lacks(method, size_of(request));
  std::optional<Turned> turned;
  if (!request.target.turn.empty()) turned.emplace(request);
  const Request& asked = turned ? turned->request() : request;
  Texture texture =
      std::visit([&](const auto& params) { return synthesise(params, asked, control); }, method);
  keep_normals_unit(texture, asked.exemplars);
  if (turned) turned->name_sources(texture.source);
  keep_known(texture.image, request.target);  // bit for bit, whatever a method computes with
  return texture;
}

Cost estimate_method(const Method& method, const RequestSize& request) {
  refuse_lacks(method, request);
  const RequestSize asked = request.turn ? size_of_turned(request) : request;
  return std::visit([&](const auto& params) { return estimate(params, asked); }, method);
}

}  // namespace gramloom
