#pragma once

#include "core/request.h"

namespace gramloom {

/// Shifts the colours and scalars of what was copied into a picture (Target::known) so that it
/// meets what stays: over each join the step becomes that of the source, as if the piece had been
/// copied with the pixels around it, and the shift is as smooth as it can be and fades within
/// `Target::blend` pixels. This is the seamless cloning of Pérez, Gangnet, Blake 2003 ("Poisson
/// image editing", section 2, in the form of a membrane that is added to what is cloned), with a
/// screen that lets it fade: the shift e solves
///   Σ (e_p − e_q)² + Σ (e_p − d_p)² + Σ e_p² / blend²  →  least,
/// over pairs of new pixels, over joins, and over new pixels; d is what the step lacks.
/// Departures: it fades (theirs fills the piece, whose middle should keep its colours); nothing is
/// done in a hole most of whose pixels at joins were copied alone, beside no neighbour of their
/// source: such have no steps to keep.
///
/// Normals and coverage stay copies, and what is transparent has no joins. Values stay within those
/// that the texture had. Nothing is done where there are no sources or nothing is known.
void blend_joins(Texture& texture, const Request& request);

}  // namespace gramloom
