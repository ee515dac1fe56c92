#pragma once

namespace gramloom {

/// While one of these lives, what C libraries print to `stderr` goes nowhere: libpng has lines of
/// its own about damaged pictures, and OpenImageIO offers no way to take them. Counted, so that
/// several threads may each have one. What is written to the file descriptor is not touched.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
};

}  // namespace gramloom
