#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace gramloom {

/// Counter-based random numbers: Philox 4×32 with 10 rounds (Salmon, Moraes, Dror, Shaw 2011,
/// "Parallel random numbers: as easy as 1, 2, 3"). The numbers depend on (seed, stream) and on how
/// many were drawn, and on nothing else, so work can be split over threads at will: give each
/// pixel, patch or step a stream of its own, never each thread.
/// The same numbers on every machine: only integer arithmetic and exactly rounded float operations.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : seed_(seed), stream_(stream) {}

  /// An independent generator for a part of this one's work; it does not advance this one.
  Random stream(std::uint64_t part) const;

  /// Uniform over all 2³² values.
  std::uint32_t bits();
  /// Many at once: the same as from one bits() after the other, and quicker.
  void fill(std::span<std::uint32_t> words);
  /// Uniform in [0, 1), a multiple of 2⁻²⁴.
  float uniform();
  /// Uniform in [low, high).
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, …, count − 1}, without bias; count ≥ 1.
  std::uint32_t below(std::uint32_t count);
  /// Normal with mean 0 and standard deviation 1 (inverse of the distribution function).
  float normal();

  std::uint64_t seed() const { return seed_; }

 private:
  std::uint64_t seed_;
  std::uint64_t stream_;
  std::uint64_t block_ = 0;
  std::array<std::uint32_t, 4> buffer_{};
  int left_ = 0;
};

/// Four words of Philox 4×32-10 for a counter and a key: the function that Random walks along.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

}  // namespace gramloom
