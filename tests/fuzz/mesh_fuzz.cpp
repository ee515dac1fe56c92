// Meshes.
#include "fuzz.h"
#include "surface/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  read_or_refuse([&] { read_mesh(file_of(text, ".obj")); });
  return 0;
}
