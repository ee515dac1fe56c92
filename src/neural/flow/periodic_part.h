#pragma once

#include "core/image.h"

namespace gramloom::neural {

/// Along an axis on which the exemplar has courses: their period in its pixels, and how many of
/// them a picture has. No courses: both 0.
struct PeriodicAxis {
  double period = 0;
  int count = 0;
};

/// What of an exemplar repeats: its mean over all courses, laid out in a picture of that size. On
/// an axis without courses it is the mean over that axis.
Image periodic_part(const Image& exemplar, PeriodicAxis x, PeriodicAxis y, Size size);

}  // namespace gramloom::neural
