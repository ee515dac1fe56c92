#pragma once

#include <string_view>
#include <type_traits>
#include <variant>

#include "classic/histogram.h"
#include "classic/markov.h"
#include "classic/patchmatch.h"
#include "classic/phase.h"
#include "classic/pixel.h"
#include "classic/pyramid.h"
#include "classic/quilting.h"
#include "core/fields.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"
#include "neural/synthesis.h"
#include "procedural/texture.h"

namespace gramloom {

/// Every method that a config can name: the one list of them. A method is one of these structs and
/// the functions synthesise and estimate beside it.
using Method =
    std::variant<NeuralParams, QuiltingParams, PatchmatchParams, PixelParams, PyramidParams,
                 PhaseParams, MarkovParams, HistogramParams, ProceduralParams>;

/// A method that makes a texture from a picture of one; the others need no exemplar.
template <class Params>
concept NeedsExemplar = requires(const Params& params, const Image& exemplar, const Target& target,
                                 Random random, const Control& control) {
  synthesise(params, exemplar, target, random, control);
};

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

std::string_view kind_of(const Method& method);
bool needs_exemplar(const Method& method);

/// Runs the method; `exemplar` is not looked at by one that needs none. (Not called synthesise: as
/// a params struct converts to a Method, every method would seem to need an exemplar.)
Texture run_method(const Method& method, const Image& exemplar, const Target& target, Random random,
                   const Control& control);
/// What it would need for an exemplar of this size and number of channels.
Cost estimate_method(const Method& method, Size exemplar, int channels, const Target& target);

/// Calls f(field, value) for every parameter of `params` in order: its own, then those of the
/// sub-method that it holds.
template <class Params, class F>
void for_each_parameter(Params& params, F&& f) {
  for_each_field<std::remove_const_t<Params>>(
      [&](const auto& field) { f(field, params.*field.member); });
  if constexpr (HasVariant<Params>)
    std::visit([&](auto& held) { for_each_parameter(held, f); }, params.texture);
}

}  // namespace gramloom
