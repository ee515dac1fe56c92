#include "python/arrays.h"

#include <Imath/half.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "io/check_finite.h"
#include "io/image_encode.h"

namespace gramloom::python {

namespace {

struct NamedType {
  const char* name;  // NumPy's
  PixelType type;
};
constexpr auto types = std::to_array<NamedType>({{"uint8", PixelType::uint8},
                                                 {"uint16", PixelType::uint16},
                                                 {"float16", PixelType::half},
                                                 {"float32", PixelType::float32}});

py::dtype dtype_of(PixelType type) {
  for (const NamedType& known : types)
    if (known.type == type) return py::dtype(known.name);
  throw Error("a type of pixels that NumPy does not know");
}

// As the reader of files does: integers become the nearest float to k / max.
template <class Value>
std::vector<float> floats_of(const void* data, std::size_t count) {
  const auto* values = static_cast<const Value*>(data);
  std::vector<float> floats(values, values + count);
  if constexpr (std::is_integral_v<Value>)
    for (float& value : floats) value /= static_cast<float>(std::numeric_limits<Value>::max());
  return floats;
}

std::vector<float> floats_of(const void* data, std::size_t count, PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return floats_of<std::uint8_t>(data, count);
    case PixelType::uint16:
      return floats_of<std::uint16_t>(data, count);
    case PixelType::half:
      return floats_of<Imath::half>(data, count);
    case PixelType::float32:
      break;
  }
  return floats_of<float>(data, count);
}

// Those that a file has by default: the second or the fourth channel is alpha.
std::vector<std::string> channel_names(int channels) {
  if (channels == 2) return {"Y", "A"};
  if (channels == 4) return {"R", "G", "B", "A"};
  return {};
}

int side(py::ssize_t length) {
  return static_cast<int>(std::min<py::ssize_t>(length, std::numeric_limits<int>::max()));
}

}  // namespace

PixelType pixel_type_of(const py::handle& dtype, const std::string& name) {
  const py::dtype given = py::dtype::from_args(py::reinterpret_borrow<py::object>(dtype));
  for (const NamedType& known : types)
    if (given.equal(py::dtype(known.name))) return known.type;
  throw ConfigError("{}: values of type {}: allowed are uint8, uint16, float16, float32", name,
                    std::string(py::str(py::handle(given))));
}

Picture picture_of(const py::handle& object, const std::string& name) {
  const py::array array = py::array::ensure(object, py::array::c_style);
  if (!array) {
    PyErr_Clear();
    throw ConfigError("{}: is no array", name);
  }
  const PixelType type = pixel_type_of(array.dtype(), name);
  if (array.ndim() != 2 && array.ndim() != 3)
    throw ConfigError(
        "{}: an array of {} dimensions: allowed are (height, width) and (height, width, channels)",
        name, array.ndim());
  if (array.size() == 0) throw ConfigError("{}: the array is empty", name);
  Picture picture;
  picture.flat = array.ndim() == 2;
  Image& image = picture.file.image;
  image.height = side(array.shape(0));
  image.width = side(array.shape(1));
  image.channels = picture.flat ? 1 : side(array.shape(2));
  image.pixels = floats_of(array.data(), static_cast<std::size_t>(array.size()), type);
  picture.file.encoding.pixel_type = type;
  picture.file.encoding.channel_names = channel_names(image.channels);
  try {
    check_finite(image);
    check_no_data(image);
  } catch (const Error& error) {
    throw ConfigError("{}: {}", name, error.what());
  }
  return picture;
}

Stored stored(const Image& image, PixelType type) {
  Stored stored{{}, type, stored_pixels(image, type)};
  stored.image.width = image.width;
  stored.image.height = image.height;
  stored.image.channels = image.channels;
  return stored;
}

py::array array_of(const Stored& picture, bool flat) {
  std::vector<py::ssize_t> shape{picture.image.height, picture.image.width};
  if (!flat || picture.image.channels != 1) shape.push_back(picture.image.channels);
  py::array array(dtype_of(picture.type), shape);
  std::memcpy(array.mutable_data(), picture.values.data(), picture.values.size());
  return array;
}

}  // namespace gramloom::python
