#pragma once

#include "core/request.h"
#include "core/simd.h"
#include "procedural/canvas.h"
#include "procedural/ramp.h"

namespace gramloom {

/// What a texture is at a point. Height and mask are in [0, 1].
struct Surface {
  Rgb colour;
  Floats height = Floats{};
  Floats mask = Floats{};
};

/// Which maps a texture has beside its colour.
struct Maps {
  bool height = false;
  bool mask = false;
};

GRAMLOOM_INLINE Point<2> flat(const Point<4>& p) { return {{p.at[0], p.at[1]}}; }
GRAMLOOM_INLINE Point<3> solid(const Point<4>& p) { return {{p.at[0], p.at[1], p.at[2]}}; }

namespace detail {

/// The surfaces at `packs` times eight points. It alone is compiled for every texture, since that
/// is slow: what a picture is made of these by stands in render.cpp, once.
template <class Shader>
GRAMLOOM_SIMD void shade(const void* shader, const Point<4>* points, int packs, Surface* surfaces) {
  for (int k = 0; k < packs; ++k) surfaces[k] = (*static_cast<const Shader*>(shader))(points[k]);
}
using Shade = void (*)(const void* shader, const Point<4>* points, int packs, Surface* surfaces);

Texture render(const void* shader, Shade shade, const Canvas& canvas, const Maps& maps);

}  // namespace detail

/// Evaluates `shader`, a function object Surface(const Point<4>&), on the canvas.
template <class Shader>
Texture render(const Shader& shader, const Canvas& canvas, const Maps& maps = {}) {
  return detail::render(&shader, &detail::shade<Shader>, canvas, maps);
}

/// Bakes the light into the colour: `relief` is how far apart, in features, the heights 0 and 1
/// are. The slopes facing the canvas's light become lighter, those turned away and the hollows
/// darker.
void light_relief(Texture& texture, const Canvas& canvas, double relief);

}  // namespace gramloom
