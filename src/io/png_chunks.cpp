#include "io/png_chunks.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "core/error.h"

namespace gramloom {

void check_png_chunks(const std::filesystem::path& path) {
  constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
  std::array<char, 8> bytes{};  // the signature, then of each chunk: length, big-endian, and type
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  if (!file || std::string_view(bytes.data(), bytes.size()) != signature) return;

  while (file.read(bytes.data(), bytes.size())) {
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<std::uint8_t>(bytes[i]);
    constexpr int checksum = 4;
    file.seekg(static_cast<std::streamoff>(length) + checksum - 1, std::ios::cur);
    const bool complete = file.get() != std::ifstream::traits_type::eof();
    if (complete && std::string_view(bytes.data() + 4, 4) == "IEND") return;
  }
  throw Error("truncated or damaged: the PNG ends before its end mark");
}

}  // namespace gramloom
