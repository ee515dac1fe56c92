#pragma once

#include <string>
#include <vector>

#include "core/request.h"
#include "io/image_file.h"
#include "jobs/config.h"

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

/// An exemplar as methods see it, and its files: the picture, then its maps by name. Methods weigh
/// channels by their values: a map in floats beyond 0 to 1, such as metres, is brought there, or it
/// would outweigh the colours.
struct LoadedExemplar {
  Exemplar exemplar;
  std::vector<ExemplarFile> files;
  std::vector<std::string> notes = {};  // "h.tif: …": where values are not quite those of the files
};

/// Reads the picture and its maps and scales them to max_side, after which normals are of unit
/// length again. Normals of [-1, 1], as float files may have them, come as (1 + component) / 2.
/// Throws ConfigError when a map has another size than the picture, or too few channels for its
/// kind; Error for a file that cannot be read.
LoadedExemplar load_exemplar(const ExemplarEntry& entry);

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
