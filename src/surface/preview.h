#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/cost.h"
#include "core/image.h"
#include "core/progress.h"
#include "surface/preview_params.h"
#include "surface/volume.h"

namespace gramloom {

/// Colours of a solid at points of it: linear ones, where the shape's ball is [0, 1]³ (y up).
/// `width`: of what each point stands for. Called from several threads.
using Solid =
    std::function<void(std::span<const Vec3> points, float width, std::span<Vec3> colours)>;

/// What a shape is covered with, or carved from.
struct PreviewMaterial {
  Image colour;  // linear values; one channel is grey; empty: white
  std::map<std::string, Image>
      maps;                         // of its size: height, normal, roughness, metalness, occlusion
  GreenAxis green = GreenAxis::up;  // of the normals, unless the params say it
  Tile wraps = Tile::none;          // edges at which the pictures are known to tile
  Volume volume;                    // for Mapping::solid, linear values
  Solid solid;                      // or this
};

/// The names of maps that a preview knows.
inline constexpr auto preview_maps =
    std::to_array<std::string_view>({"height", "normal", "roughness", "metalness", "occlusion"});

/// `picture`, whose colours are stored as sRGB, with linear values.
Image linear_picture(const Image& picture);

/// Whether a relief by the heights is asked for: then it goes before a normal map.
bool asks_for_relief(const PreviewParams& params);

/// Throws Error for maps that a preview does not know, of other sizes, or of too many channels.
void check_material(const PreviewMaterial& material);

/// Throws ConfigError for parameters out of range, or that don't fit together.
void check_preview(const PreviewParams& params);

/// What render_preview() takes for a material of this size with all maps.
Cost estimate_preview(const PreviewParams& params, Size material);

struct RenderedPreview {
  Image picture;
  std::vector<std::string> notes;  // what is not shown as it is
};

/// The picture of a shape with one material, or with two that share it by the params' pattern: four
/// channels with linear values and alpha. `environment`: a picture with linear values, of the kind
/// that the params say; empty: a studio. The same bytes for any number of threads.
/// Throws ConfigError for parameters out of range, Error for maps of different sizes, an
/// environment of other proportions, a mesh that cannot be used, a mapping that does not suit the
/// material; Interrupted when told to stop.
RenderedPreview render_preview(const PreviewParams& params,
                               std::span<const PreviewMaterial> materials, const Image& environment,
                               const Control& control);

/// How a file holds such a picture: as it is to be seen, sRGB with highlights above 0.8 pressed
/// together, or as light, in linear values.
enum class Shown { colours, light };

/// Such a picture as a file holds it; without its alpha channel unless the background is
/// transparent.
Image shown_preview(const PreviewParams& params, const Image& rendered,
                    Shown shown = Shown::colours);

}  // namespace gramloom
