// Descriptions of networks.
#include "fuzz.h"
#include "neural/network/network_description.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  read_or_refuse([&] {
    const NetworkDescription network = read_network(file_of(text, ".toml"));
    map_sizes(network, {64, 48}, Tile::both);
    filter_shapes(network, 3);
  });
  return 0;
}
