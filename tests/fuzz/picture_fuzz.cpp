// Pictures, through OpenImageIO into our code: the first byte chooses the ending.
#include <array>

#include "fuzz.h"
#include "io/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  if (text.empty()) return 0;
  constexpr std::array endings{".png", ".jpg", ".tif", ".exr", ".tga", ".bmp", ".ppm", ".hdr"};
  read_or_refuse([&] { read_image(file_of(text.substr(1), endings[data[0] % endings.size()])); });
  return 0;
}
