#pragma once

#include <string>

#include "learnt/plain_generator.h"

namespace gramloom {

/// A generator as one file of C99 that needs nothing but malloc():
///   int NAME_generate(float *pixels, int width, int height, unsigned seed, int tile);
/// and, with GRAMLOOM_MAIN defined, a program that writes a picture. Its first comment says what
/// both do, and how near they come to generate(): export_c_tolerance. `name`: an identifier.
/// `program`: what made it, for that comment.
std::string export_c(const PlainGenerator& generator, const std::string& name,
                     const std::string& program);

/// By how much a value of its pictures may differ from generate()'s, in shares of the channel's
/// range, whatever the compiler.
inline constexpr double export_c_tolerance = 1e-4;

}  // namespace gramloom
