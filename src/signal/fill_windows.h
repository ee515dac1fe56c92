#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

/// The first exemplar of which the target is the same picture: every known pixel is the exemplar's
/// own at the same place, as far as that may be used.
std::optional<std::size_t> same_picture(const Request& request);

/// A part of a picture with holes: where it lies, and the pixels of its holes.
struct FillWindow {
  int left = 0, top = 0;
  Size size;
  std::vector<std::size_t> made;  // indices into the whole target
};

/// Windows about the holes of a picture that is filled from itself, so that what is far from every
/// hole costs nothing: holes that are near each other share one. None where edges meet, or where
/// together they would be more than `most` times the picture: they overlap.
std::vector<FillWindow> fill_windows(const Request& request, double most);

/// One window about all holes of a fill, for a method that takes them all together
/// (RequestSize::around says whether it can).
FillWindow window_about_holes(const Target& target);

/// Fills each window by itself, in parallel, and the whole with them. `fill`: the method, which
/// reports to its control; of a single window that is the caller's, of several nobody's, as then
/// the windows are the steps. A picture that is filled from others has these whole in each window.
Texture fill_by_windows(const Request& request, const std::vector<FillWindow>& windows,
                        const std::function<Texture(const Request&, const Control&)>& fill,
                        const Control& control);

}  // namespace gramloom
