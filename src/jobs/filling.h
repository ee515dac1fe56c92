#pragma once

#include <string>

#include "jobs/picture_files.h"

namespace gramloom {

/// A picture of which a part is made anew, as methods are asked for it.
struct Filling {
  Image known;   // the picture, with what it is extended by
  Image mask;    // 1 where it is made anew
  Image usable;  // of the picture as it was: 1 where it is not
};

/// Where a picture begins in what it is extended to.
struct Corner {
  int left = 0;
  int top = 0;
};
Corner corner_of(const FillEntry& fill);

/// `size` is that of the result. `from_itself`: what is made is made of the picture's other pixels.
/// Throws ConfigError when nothing is to be made anew, or nothing is left to make it of.
Filling filling_of(const FillEntry& fill, PictureFiles picture, Size size, bool from_itself,
                   const std::string& place);

}  // namespace gramloom
