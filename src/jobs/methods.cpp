#include "jobs/methods.h"

namespace gramloom {

std::string_view kind_of(const Method& method) {
  return std::visit([](const auto& params) { return std::decay_t<decltype(params)>::kind; },
                    method);
}

bool needs_exemplar(const Method& method) {
  return std::visit([]<class Params>(const Params&) { return NeedsExemplar<Params>; }, method);
}

Texture run_method(const Method& method, const Image& exemplar, const Target& target, Random random,
                   const Control& control) {
  return std::visit(
      [&]<class Params>(const Params& params) {
        if constexpr (NeedsExemplar<Params>)
          return synthesise(params, exemplar, target, random, control);
        else
          return synthesise(params, target, random, control);
      },
      method);
}

Cost estimate_method(const Method& method, Size exemplar, int channels, const Target& target) {
  return std::visit(
      [&]<class Params>(const Params& params) {
        if constexpr (NeedsExemplar<Params>)
          return estimate(params, exemplar, channels, target);
        else
          return estimate(params, target);
      },
      method);
}

}  // namespace gramloom
