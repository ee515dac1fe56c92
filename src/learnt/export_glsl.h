#pragma once

#include <string>

#include "learnt/plain_generator.h"

namespace gramloom {

/// Of what follows: other numbers are for other drivers.
inline constexpr int export_glsl_format = 1;

/// A generator as the fragment shaders of WebGL 2 (GLSL ES 3.00), one text: which pass it is says
/// PASS. Each writes at most four layers of an array of textures (RGBA32F, four channels a layer),
/// as every WebGL 2 can. It begins with a comment, whose first line is JSON:
///   format     export_glsl_format
///   title, licence, channels
///   levels     [{border} …], the coarsest first
///   textures   {name: {level, border, layers} …}: larger than the level's picture by `border`
///              pixels on each side
///   passes     [{reads: {uniform: texture …}, writes: texture, first: layer, count: layers} …];
///              the last writes "picture"
/// The comment's other lines say what a driver must know besides; report/live.js is one.
std::string export_glsl(const PlainGenerator& generator, const std::string& program);

}  // namespace gramloom
