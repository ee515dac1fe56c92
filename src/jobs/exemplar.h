#pragma once

#include <string>
#include <vector>

#include "io/image_file.h"
#include "jobs/config.h"

namespace gramloom {

/// What one file gives to an exemplar, and how the file stores it.
struct ExemplarLayer {
  std::string map;  // the map's name; "" for the picture itself
  int channels = 0;
  Encoding encoding;
  float low = 0;  // the file's values that 0 and 1 of the joined image stand for
  float high = 1;
};

/// An exemplar as methods see it: its picture and the maps of the same surface joined to one image,
/// so that a method makes them together and they stay registered. Methods weigh channels by their
/// values: a map in floats beyond 0 to 1, such as metres, is brought there, or it would outweigh
/// the colours.
struct Exemplar {
  Image image;                        // the channels of one layer after the other
  std::vector<ExemplarLayer> layers;  // the picture, then its maps by name
};

/// Reads the picture and its maps and scales them to max_side. Throws ConfigError when a map has
/// another size than the picture, Error for a file that cannot be read.
Exemplar load_exemplar(const ExemplarEntry& entry);

/// The number of channels of the joined image.
int channels_of(const std::vector<ExemplarLayer>& layers);

/// The channels of the picture alone.
Image picture_of(const Exemplar& exemplar);

/// A texture of an exemplar with these layers, parted into the picture and its maps. Without maps
/// it stays as it is.
Texture split_layers(Texture texture, const std::vector<ExemplarLayer>& layers);

}  // namespace gramloom
