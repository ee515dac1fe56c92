#pragma once

#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "classic/histogram.h"
#include "classic/markov.h"
#include "classic/patchmatch.h"
#include "classic/phase.h"
#include "classic/pixel.h"
#include "classic/pyramid.h"
#include "classic/quilting.h"
#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"
#include "learnt/generator.h"
#include "neural/synthesis.h"
#include "procedural/texture.h"
#include "surface/tiling.h"

namespace gramloom {

/// Every method that a config can name: the one list of them. A method is one of these structs and
/// the functions synthesise and estimate beside it.
using Method = std::variant<NeuralParams, QuiltingParams, PatchmatchParams, PixelParams,
                            PyramidParams, PhaseParams, MarkovParams, HistogramParams, TilingParams,
                            GeneratorParams, ProceduralParams>;

/// A method that holds one of several sub-methods, chosen by their `name` under the key
/// `variant_key`, in its member `texture`.
template <class Params>
concept HasVariant = requires {
  Params::variant_key;
};

/// A method with complete settings to start from, chosen by a word under the key `preset`.
template <class Params>
concept HasPresets = requires(const Params& params) {
  with_preset(params.preset);
};

/// A method that may look up the description of a network by its name.
template <class Params>
concept HasNetwork = requires(const Params& params) {
  network_file(params);
};

/// A method that makes its textures without an exemplar, and may name one of the config's that they
/// are scored against.
template <class Params>
concept HasComparison = requires(const Params& params) {
  params.exemplar;
};
/// The name of that exemplar; "": none.
std::string compared_with(const Method& method);

/// A method that uses a trained model, a file of its own or one that it looks up by its name.
template <class Params>
concept HasModel = requires(const Params& params) {
  model_file(params);
};

std::string_view kind_of(const Method& method);
Abilities abilities_of(const Method& method);
/// A method without this ability needs no exemplar, and takes none.
inline bool needs_exemplar(const Method& method) {
  return abilities_of(method).has(Ability::exemplar);
}
/// The kinds of methods with this ability, in their order.
std::vector<std::string_view> methods_with(Ability ability);

/// What the method makes of the request, and what it would need for that. Both throw Error for what
/// the method cannot do, with the methods that can. Normals of the texture are of unit length
/// (jobs/unit_normals.h), and known pixels are as they were, bit for bit.
Texture run_method(const Method& method, const Request& request, const Control& control);
Cost estimate_method(const Method& method, const RequestSize& request);

/// Calls f(field, value) for every parameter of `params` in order: its own, then those of the
/// sub-method that it holds.
template <class Params, class F>
void for_each_parameter(Params& params, F&& f) {
  for_each_value(params, f);
  if constexpr (HasVariant<Params>)
    std::visit([&](auto& held) { for_each_parameter(held, f); }, params.texture);
}

}  // namespace gramloom
