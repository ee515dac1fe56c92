#include "core/random.h"

#include <algorithm>

#include "core/portable_math.h"
#include "core/simd.h"

namespace gramloom {

namespace {

std::uint32_t low(std::uint64_t v) { return static_cast<std::uint32_t>(v); }
std::uint32_t high(std::uint64_t v) { return static_cast<std::uint32_t>(v >> 32); }

template <std::size_t N>
double polynomial(const double (&coefficients)[N], double x) {
  double sum = 0;
  for (const double c : coefficients) sum = sum * x + c;
  return sum;
}

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

// Acklam's rational approximation of the inverse normal distribution function (relative error
// 1.15e-9, well below float's): only division, square root and our own logarithm.
double inverse_normal(double p) {
  constexpr double a[] = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                          1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr double b[] = {-5.447609879822406e+01, 1.615858368580409e+02,  -1.556989798598866e+02,
                          6.680131188771972e+01,  -1.328068155288572e+01, 1.0};
  constexpr double c[] = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                          -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr double d[] = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                          3.754408661907416e+00, 1.0};
  constexpr double tail = 0.02425;
  if (p > 1 - tail) return -inverse_normal(1 - p);
  if (p < tail) {
    const double q = portable::sqrt(-2 * portable::log(p));
    return polynomial(c, q) / polynomial(d, q);
  }
  const double q = p - 0.5;
  return q * polynomial(a, q * q) / polynomial(b, q * q);
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
  return static_cast<float>(inverse_normal((static_cast<double>(bits()) + 0.5) * 0x1p-32));
}

}  // namespace gramloom
