#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gramloom {

/// FNV-1a, 64 bits (Fowler, Noll, Vo): tells texts and files apart, no more.
class Fnv1a {
 public:
  void add(const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      value_ = (value_ ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
  }
  void add(std::string_view text) { add(text.data(), text.size()); }

  /// 16 hexadecimal digits.
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// The hash of these bytes alone.
inline std::string hash_of(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.text();
}

}  // namespace gramloom
