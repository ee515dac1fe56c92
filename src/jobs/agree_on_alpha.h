#pragma once

#include <string>
#include <vector>

#include "jobs/picture_files.h"

namespace gramloom {

/// Makes pictures of one material alike in whether they have alpha. Without a picture that is
/// filled those without become opaque. One that is filled, the last of `pictures`, keeps its
/// channels: the others become opaque, or lose their alpha. What was done is added to their notes.
/// `masks`: what of each picture may be used; empty: all. Throws ConfigError, beginning with
/// `place`, where pixels that are transparent may be used for a picture without alpha.
void agree_on_alpha(std::vector<PictureFiles>& pictures, const std::vector<Image>& masks,
                    bool fills, const std::string& place);

}  // namespace gramloom
