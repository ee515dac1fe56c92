#pragma once

#include <pybind11/numpy.h>

#include <string>

#include "io/image_file.h"

namespace gramloom::python {

namespace py = pybind11;

/// An array of NumPy's, or what NumPy makes one of, as a file of its values would be read: of shape
/// (height, width) or (height, width, channels), and of type uint8, uint16, float16 or float32.
/// `name` is what errors call it. Throws ConfigError.
struct Picture {
  ImageFile file;
  bool flat = false;  // has no axis of channels
};
Picture picture_of(const py::handle& array, const std::string& name);

/// A picture's values as a file of this type holds them.
struct Stored {
  Image image;  // without its pixels
  PixelType type = PixelType::uint8;
  std::vector<std::byte> values;
};
Stored stored(const Image& image, PixelType type);

/// With an axis of channels, or `flat`, without one where there is only one channel.
py::array array_of(const Stored& picture, bool flat);

/// The type of values that a NumPy dtype, or what NumPy makes one of, stands for. Throws
/// ConfigError.
PixelType pixel_type_of(const py::handle& dtype, const std::string& name);

}  // namespace gramloom::python
