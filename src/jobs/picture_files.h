#pragma once

#include <string>
#include <vector>

#include "jobs/config.h"
#include "jobs/exemplar.h"

namespace gramloom {

/// A picture and its maps as their files hold them.
struct PictureFiles {
  std::filesystem::path file;  // of the picture
  std::vector<Image> images;   // the picture, then its maps by name
  std::vector<ExemplarFile> files;
  Metadata metadata;  // of the picture
  std::vector<std::string> notes;
};

/// Throws ConfigError, beginning with `place`, when a map has another size than the picture, or too
/// few channels for its kind; Error for a file that cannot be read.
PictureFiles read_picture(const ExemplarPicture& picture, const std::string& place);

/// Makes pictures of one material comparable: methods weigh channels by their values, so a map in
/// floats beyond 0 to 1, such as metres, is brought there, the same map of all pictures alike.
/// Throws ConfigError when they differ in their maps or in the channels or kinds of these.
void fit_together(std::vector<PictureFiles>& pictures, const std::string& place);

/// The picture with its maps' channels behind its own.
Image joined(PictureFiles picture);

/// One channel of a picture of this size: 1 where it is bright, or, of one called "alpha", where
/// the picture that it belongs to is opaque. `what` is "the mask". Throws ConfigError for another
/// size, and for a picture without alpha.
Image read_mask(const FileOrName& mask, const PictureFiles& picture, const std::string& what,
                const std::string& place);

/// A picture that must have this size, that of `of`. Throws ConfigError that names both.
ImageFile read_sized(const std::filesystem::path& file, Size size, const std::string& what,
                     const std::string& of, const std::string& place);

/// Mean of the channels but for alpha, one channel.
Image brightness(ImageFile picture);

}  // namespace gramloom
