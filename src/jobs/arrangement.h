#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/request.h"
#include "jobs/filling.h"

namespace gramloom {

/// Where each pixel of a texture was copied from, and how large the pictures were that it was
/// copied from: what arranges other pictures alike.
struct Arrangement {
  SourceMap source;
  std::vector<Size> pictures;
};

/// A texture's coordinates. Pixels that were known are those of the exemplar where that is the
/// picture that was filled, which begins `filled_at` in the texture; else of one more picture
/// behind the exemplars, of the texture's size.
Arrangement arrangement_of(const SourceMap& source, const Request& request,
                           const std::optional<Corner>& filled_at);

/// Writes "NAME_coordinates.tif": x, y and the number of the picture, as 16-bit integers, or as
/// floats where a side is longer; the sizes are in its metadata. Returns the file's name.
std::string write_arrangement(const std::filesystem::path& folder, const std::string& name,
                              const Arrangement& arrangement);

/// Throws Error, one line with the file, for what is no such file, or was changed since.
Arrangement read_arrangement(const std::filesystem::path& file);

}  // namespace gramloom
