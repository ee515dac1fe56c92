#pragma once

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

}  // namespace gramloom::neural
