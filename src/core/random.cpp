#include "core/random.h"

#include <algorithm>

#include "core/portable_math.h"
#include "core/simd.h"

namespace gramloom {

namespace {

std::uint32_t low(std::uint64_t v) { return static_cast<std::uint32_t>(v); }
std::uint32_t high(std::uint64_t v) { return static_cast<std::uint32_t>(v >> 32); }

constexpr std::size_t lanes = 32;  // fewer become a list of statements that are not vectorised

/// philox() of counters (block + lane, stream), lane by lane.
GRAMLOOM_SIMD void philox_lanes(std::uint64_t block, std::uint64_t stream, std::uint64_t seed,
                                std::uint32_t* __restrict words) {
  std::uint32_t a[lanes], b[lanes], c[lanes], d[lanes];
  for (std::size_t i = 0; i < lanes; ++i) {
    a[i] = low(block + i);
    b[i] = high(block + i);
    c[i] = low(stream);
    d[i] = high(stream);
  }
  for (std::uint32_t round = 0; round < 10; ++round) {
    const std::uint32_t key0 = low(seed) + round * 0x9E3779B9u;
    const std::uint32_t key1 = high(seed) + round * 0xBB67AE85u;
    for (std::size_t i = 0; i < lanes; ++i) {
      const std::uint64_t p0 = std::uint64_t{0xD2511F53} * a[i];
      const std::uint64_t p1 = std::uint64_t{0xCD9E8D57} * c[i];
      a[i] = high(p1) ^ b[i] ^ key0;
      b[i] = low(p1);
      c[i] = high(p0) ^ d[i] ^ key1;
      d[i] = low(p0);
    }
  }
  for (std::size_t i = 0; i < lanes; ++i) {
    words[4 * i] = a[i];
    words[4 * i + 1] = b[i];
    words[4 * i + 2] = c[i];
    words[4 * i + 3] = d[i];
  }
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {high(p1) ^ counter[1] ^ key[0], low(p1), high(p0) ^ counter[3] ^ key[1], low(p0)};
    key = {key[0] + 0x9E3779B9u, key[1] + 0xBB67AE85u};
  }
  return counter;
}

Random Random::stream(std::uint64_t part) const {
  // A hash of (own stream, part) is the child's stream: two levels of splitting never collide in
  // practice, and the seed stays what the user wrote.
  const auto words =
      philox({low(part), high(part), 0x6C6F6F6Du, 0x6772616Du}, {low(stream_), high(stream_)});
  return Random(seed_, (std::uint64_t{words[1]} << 32) | words[0]);
}

std::uint32_t Random::bits() {
  if (left_ == 0) {
    buffer_ =
        philox({low(block_), high(block_), low(stream_), high(stream_)}, {low(seed_), high(seed_)});
    ++block_;
    left_ = 4;
  }
  return buffer_[static_cast<std::size_t>(4 - left_--)];
}

void Random::fill(std::span<std::uint32_t> words) {
  auto next = words.begin();
  for (; left_ > 0 && next != words.end(); ++next) *next = bits();
  for (; words.end() - next >= std::ptrdiff_t{4 * lanes}; next += 4 * lanes, block_ += lanes)
    philox_lanes(block_, stream_, seed_, &*next);
  std::generate(next, words.end(), [this] { return bits(); });
}

float Random::uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }

std::uint32_t Random::below(std::uint32_t count) {
  // Lemire 2019, "Fast random integer generation in an interval".
  std::uint64_t product = std::uint64_t{bits()} * count;
  if (low(product) < count) {
    const std::uint32_t threshold = (0u - count) % count;
    while (low(product) < threshold) product = std::uint64_t{bits()} * count;
  }
  return high(product);
}

float Random::normal() {
  return static_cast<float>(
      portable::inverse_normal((static_cast<double>(bits()) + 0.5) * 0x1p-32));
}

}  // namespace gramloom
