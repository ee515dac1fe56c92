#pragma once

#include <type_traits>
#include <variant>

#include "core/variants.h"
#include "neural/loss/autocorrelation.h"
#include "neural/loss/gram.h"
#include "neural/loss/sliced.h"
#include "neural/loss/sliced_features.h"
#include "neural/loss/spectrum.h"
#include "neural/loss/variation.h"

namespace gramloom {

/// Every term of the loss: the one list of them. A term is a struct of parameters with its `name`,
/// its weight() and its fields, whose names are keys of the config, and beside it the functions
/// cost(), which needs no LibTorch, and make_term(). Each is about 1 for a picture of one colour
/// (Gram matrices: when all features are 0) and 0, or nearly, for the exemplar itself.
/// To add one: its header, its .cpp, and its name here.
using LossTerms = std::variant<SlicedParams, GramParams, SlicedFeaturesParams, SpectrumParams,
                               AutocorrelationParams, VariationParams>;

/// A term that looks at a network's layers, not at the picture alone.
template <class Term>
concept LooksAtNetwork =
    std::is_same_v<decltype(make_term(std::declval<const Term&>(),
                                      std::declval<const neural::LossInput&>())),
                   std::unique_ptr<neural::FeatureTerm>>;

namespace detail {
template <class>
struct ParamsOf;
template <class... Terms>
struct ParamsOf<std::variant<Terms...>> : Terms... {
  static constexpr auto fields() { return std::tuple_cat(Terms::fields()...); }
};
}  // namespace detail

/// The parameters of all terms.
struct LossParams : detail::ParamsOf<LossTerms> {};

/// Calls f(term) with the parameters of each term that counts.
template <class F>
void for_each_term(const LossParams& params, F&& f) {
  for_each_alternative<LossTerms>([&]<class Term>(std::type_identity<Term>) {
    if (const Term& term = params; term.weight() > 0) f(term);
  });
}

}  // namespace gramloom
