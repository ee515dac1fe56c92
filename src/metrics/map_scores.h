#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/request.h"
#include "metrics/scores.h"

namespace gramloom {

/// Every score of a map (a texture's height, its normals): which of them a map has depends on its
/// kind.
std::span<const Metric> map_metrics();

/// Scores of a map against the exemplar's, of any sizes, by name:
///   normals ((1 + component)/2 in three channels)
///     normal_angle   of how the surface leans: the mean, over nine directions above it, of the
///                    Wasserstein-1 distance of the normals' angles to that direction, in degrees
///     normal_bend    of how it bends: that of the angles between neighbouring normals, in degrees
///   others, the mean over channels
///     value_distance of the values, in the exemplar's standard deviations
///     step_distance  of the differences between neighbours, in the exemplar's mean difference
/// Of more than 65536 pixels as many are taken. Both maps as a joined exemplar has them, with
/// further channels left out for normals. Throws Error for an empty map or different channels.
std::vector<std::pair<std::string_view, double>> score_map(const Image& exemplar, const Image& map,
                                                           MapKind kind);

}  // namespace gramloom
