#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "core/request.h"
#include "neural/params.h"

namespace gramloom::neural {

/// What a request says beyond one exemplar that may all be used, and a size: "a mask", "several
/// exemplars", "known pixels", "a guide" or "weights"; empty: nothing.
std::string_view directed_by(const RequestSize& request);

/// The settings by which such a request is honoured; those of another as they are. Throws
/// ConfigError for a setting that cannot be honoured with it:
///   a term of the loss but sliced, as the others look at a whole rectangle; a preset's spectrum is
///   left out;
///   with known pixels: match_histogram, and originality, as all of the exemplar is looked at;
///   with a guide or weights: match_histogram;
///   with weights that are the same everywhere (one_mix): layout = "flow", whose patches are of one
///   exemplar or the other.
NeuralParams directed_settings(const NeuralParams& params, const RequestSize& request,
                               bool one_mix);
/// Whether the weights are the same everywhere.
bool has_one_mix(const Target& target);

/// The least width and the least height of the exemplars: what levels are chosen by.
Size smallest_exemplar(const RequestSize& request);
/// The size of the exemplars as one picture (signal/united.h).
Size joined_exemplars(const RequestSize& request);

/// Of a fill, with so many patches to be filled, how many of the exemplar's are looked at: 16384,
/// less above some 12,000, but at least 4096.
inline std::int64_t looked_at_for_a_fill(std::int64_t queries) {
  return std::clamp<std::int64_t>(200'000'000 / std::max<std::int64_t>(1, queries), 4096, 16384);
}

}  // namespace gramloom::neural
