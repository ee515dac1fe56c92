#include "surface/surface_module.h"

namespace gramloom {

extern "C" const SurfaceModule gramloom_surface_module;
const SurfaceModule gramloom_surface_module{surface_module::ray_scene, surface_module::lookup,
                                            surface_module::read_mesh};

}  // namespace gramloom
