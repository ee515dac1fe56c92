#pragma once

#include <string>
#include <vector>

#include "core/request.h"
#include "io/image_file.h"

namespace gramloom {

/// What one file gives to an exemplar, and how the file stores it.
struct ExemplarFile {
  std::string map;  // the map's name; "" for the picture itself
  int channels = 0;
  Encoding encoding;
  float low = 0;  // the file's values that 0 and 1 of the joined image stand for
  float high = 1;
  MapKind kind = MapKind::colour;
  GreenAxis green = GreenAxis::up;  // of normals
};

/// Scales an exemplar, with its mask and its guide, to that longer side, after which normals are of
/// unit length again. What is partly masked is masked.
void shrink(Exemplar& exemplar, int max_side);

/// The layers of the joined image, a file's or two: alpha by itself where the last channel of a
/// picture, of colours or of normals is called "A", or is the fourth.
std::vector<Layer> layers_of(const std::vector<ExemplarFile>& files);

/// The number of channels of the joined image.
int channels_of(const std::vector<ExemplarFile>& files);

/// The channels of the picture alone.
Image picture_of(const Exemplar& exemplar);

/// A texture of an exemplar of these files, parted into the picture and its maps. Without maps it
/// stays as it is.
Texture split_layers(Texture texture, const std::vector<ExemplarFile>& files);

}  // namespace gramloom
