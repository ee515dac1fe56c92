#pragma once

#include "core/image.h"

namespace gramloom {

enum class Axis { x, y };

/// How a picture repeats along one axis, as a wall does in its courses, and a grid of tiles on both
/// axes.
struct Courses {
  double period = 0;    // pixels
  double contrast = 0;  // of the correlation at whole periods to that at half ones: 0 to about 1.5
  bool alternate = false;  // every other course is more alike, as in a wall of bricks
};

/// Courses are clear from here on: photographs of walls, tiles and weaves have 0.27 to 0.71, of
/// anything else at most 0.2.
inline constexpr double clear_courses = 0.25;

/// The period along an axis for which the self-correlation, less slow changes and averaged across
/// the axis, differs most between whole and half periods. Two periods at least must fit in 0.6 of
/// the side; otherwise, and for a flat picture, the contrast is 0.
Courses find_courses(const Image& image, Axis axis);

}  // namespace gramloom
