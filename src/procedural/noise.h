#pragma once

#include <array>
#include <cstdint>

#include "core/random.h"
#include "procedural/pack.h"

namespace gramloom {

// Lattice noise in one to four dimensions: a value or a gradient at each point with integer
// coordinates, blended in between. They stay in [−1, 1], improved noise within ±1.04.

/// Where the lattice lies: lattice coordinates are point × frequency + offset. Where period > 0,
/// the noise repeats after that many lattice steps.
template <int D>
struct Lattice {
  std::array<float, D> frequency{};
  std::array<float, D> offset{};
  std::array<int, D> period{};
  std::uint32_t seed = 0;
};

/// The lattice cell around each point: its lower and upper coordinates, wrapped, and the point's
/// offset from the lower ones in [0, 1).
template <int D>
struct LatticeCell {
  Ints corner[D][2];
  Floats offset[D];
};

/// i modulo period, ≥ 0 also for negative i; |i| < 2²².
GRAMLOOM_INLINE Ints wrap(Ints i, int period) {
  if (period == 0) return i;
  const Floats turns = floor((to_floats(i) + 0.5f) / static_cast<float>(period));
  return i - period * to_ints(turns);
}

template <int D>
GRAMLOOM_INLINE LatticeCell<D> lattice_cell(const Lattice<D>& lattice, const Point<D>& p) {
  LatticeCell<D> cell;
  for (int d = 0; d < D; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const Floats x = p.at[d] * lattice.frequency[axis] + lattice.offset[axis];
    const Floats below = floor(x);
    cell.offset[d] = x - below;
    cell.corner[d][0] = wrap(to_ints(below), lattice.period[axis]);
    const Ints next = cell.corner[d][0] + 1;
    cell.corner[d][1] =
        lattice.period[axis] > 0 ? (next == lattice.period[axis] ? Ints{} : next) : next;
  }
  return cell;
}

/// A hash of lattice points by arithmetic alone: any seed, never repeats.
struct ArithmeticHash {
  std::uint32_t seed = 0;
  template <int D>
  GRAMLOOM_INLINE Uints operator()(const Ints (&corner)[D]) const {
    constexpr std::uint32_t primes[4] = {0x9E3779B1u, 0x85EBCA77u, 0xC2B2AE3Du, 0x27D4EB2Fu};
    Uints h = Uints(corner[0]) * primes[0];
    for (int d = 1; d < D; ++d) h ^= Uints(corner[d]) * primes[d];
    return hash(h ^ seed);
  }
};

/// Perlin's hash P[z + P[y + P[x]]] through a permutation of 0 … 255; repeats after 256.
struct PermutationHash {
  const std::array<std::uint8_t, 256>* permutation;
  template <int D>
  GRAMLOOM_INLINE Uints operator()(const Ints (&corner)[D]) const {
    Uints h{};
    for (int d = 0; d < D; ++d) {
      h = (h + Uints(corner[d])) & 255u;
      for (int lane = 0; lane < pack_size; ++lane) h[lane] = (*permutation)[h[lane]];
    }
    return h;
  }
};

/// The permutation that Perlin published with improved noise (2002).
const std::array<std::uint8_t, 256>& reference_permutation();

/// A random permutation and 256 random unit vectors of each dimension, by rejection from the cube.
struct GradientTable {
  std::array<std::uint8_t, 256> permutation;
  std::array<std::array<std::array<float, 4>, 256>, 4> gradients;  // [dimensions − 1][index][axis]
};
GradientTable gradient_table(Random random);

/// Random values in [−1, 1) at the lattice points; cubic blend 3t² − 2t³, or linear.
template <bool linear = false>
struct ValueNoise {
  GRAMLOOM_INLINE Floats fade(Floats t) const {
    if constexpr (linear) return t;
    return t * t * (3 - 2 * t);
  }
  template <int D>
  GRAMLOOM_INLINE Floats corner(const Lattice<D>& lattice, const Ints (&at)[D],
                                const Floats (&)[D]) const {
    return 2 * unit_float(ArithmeticHash{lattice.seed}(at)) - 1;
  }
};

/// Perlin 1985, "An image synthesizer": random unit gradients G[P[…]], blended by
/// w(t) = 2|t|³ − 3|t|² + 1 (that is: 3t² − 2t³ from corner to corner). Times 2/√D, which the
/// paper leaves out, so that it fills [−1, 1].
struct GradientNoise {
  const GradientTable* table;
  GRAMLOOM_INLINE Floats fade(Floats t) const { return t * t * (3 - 2 * t); }
  template <int D>
  GRAMLOOM_INLINE Floats corner(const Lattice<D>& lattice, const Ints (&at)[D],
                                const Floats (&offset)[D]) const {
    constexpr float norm[4] = {2.0f, 1.41421356f, 1.15470054f, 1.0f};
    const Uints index = (PermutationHash{&table->permutation}(at) ^ lattice.seed) & 255u;
    Floats dot{};
    for (int d = 0; d < D; ++d) {
      Floats g;
      for (int lane = 0; lane < pack_size; ++lane)
        g[lane] = table->gradients[D - 1][index[lane]][static_cast<std::size_t>(d)];
      dot += g * offset[d];
    }
    return norm[D - 1] * dot;
  }
};

/// Flips the sign where bit `bit` of h is set.
GRAMLOOM_INLINE Floats flip_sign(Floats v, Uints h, int bit) {
  return Floats(Uints(v) ^ ((h << (31 - bit)) & 0x80000000u));
}

/// Perlin 2002, "Improving noise": gradients to the twelve edges of a cube, and 6t⁵ − 15t⁴ + 10t³.
/// The paper is about 3-D, whose noise stays within ±1.04. Ours besides: in 4-D the 32 edges of the
/// hypercube, times 0.65; in 2-D eight even directions of which none lies along an axis or a
/// diagonal (the slice z = 0 of the cube's edges would be lined up with the axes); in 1-D the
/// sixteen slopes ±1/4 … ±2.
template <class Hash = void>
struct ImprovedNoise {
  Hash hash_of;
  GRAMLOOM_INLINE Floats fade(Floats t) const { return t * t * t * (t * (t * 6 - 15) + 10); }
  template <int D>
  GRAMLOOM_INLINE Floats corner(const Lattice<D>&, const Ints (&at)[D],
                                const Floats (&offset)[D]) const {
    return edge_gradient(hash_of(at), offset);
  }

  template <int D>
  static GRAMLOOM_INLINE Floats edge_gradient(Uints h, const Floats (&offset)[D]) {
    if constexpr (D == 1) {
      return flip_sign(offset[0] * to_floats(Ints((h & 7u) + 1u)) * 0.25f, h, 3);
    } else if constexpr (D == 4) {
      const Floats u = select(Ints((h & 31u) < 24u), offset[0], offset[1]);
      const Floats v = select(Ints((h & 31u) < 16u), offset[1], offset[2]);
      const Floats w = select(Ints((h & 31u) < 8u), offset[2], offset[3]);
      return 0.65f * (flip_sign(u, h, 0) + flip_sign(v, h, 1) + flip_sign(w, h, 2));
    } else if constexpr (D == 2) {
      const Ints steep = Ints((h & 4u) == 0u);
      const Floats u = select(steep, offset[0], offset[1]);
      const Floats v = select(steep, offset[1], offset[0]);
      return 1.41421356f * flip_sign(u, h, 0) + 0.58578644f * flip_sign(v, h, 1);
    } else {
      const Floats u = select(Ints((h & 15u) < 8u), offset[0], offset[1]);
      const Floats v = select(Ints((h & 15u) < 4u), offset[1],
                              select(Ints((h & 13u) == 12u), offset[0], offset[2]));
      return flip_sign(u, h, 0) + flip_sign(v, h, 1);
    }
  }
};

/// The same, hashed by arithmetic with the lattice's seed: what the textures use.
template <>
struct ImprovedNoise<void> {
  GRAMLOOM_INLINE Floats fade(Floats t) const { return ImprovedNoise<ArithmeticHash>{}.fade(t); }
  template <int D>
  GRAMLOOM_INLINE Floats corner(const Lattice<D>& lattice, const Ints (&at)[D],
                                const Floats (&offset)[D]) const {
    return ImprovedNoise<ArithmeticHash>::edge_gradient(ArithmeticHash{lattice.seed}(at), offset);
  }
};

/// The noise at each point: the corners' contributions, blended along one axis after the other.
template <int D, class Basis = ImprovedNoise<>>
GRAMLOOM_INLINE Floats noise(const Lattice<D>& lattice, const Point<D>& p,
                             const Basis& basis = {}) {
  const LatticeCell<D> cell = lattice_cell(lattice, p);
  Floats value[1 << D];
#pragma GCC unroll 16
  for (int k = 0; k < (1 << D); ++k) {
    Ints at[D];
    Floats offset[D];
#pragma GCC unroll 4
    for (int d = 0; d < D; ++d) {
      const int upper = (k >> d) & 1;
      at[d] = cell.corner[d][upper];
      offset[d] = upper ? cell.offset[d] - 1 : cell.offset[d];
    }
    value[k] = basis.corner(lattice, at, offset);
  }
#pragma GCC unroll 4
  for (int d = 0; d < D; ++d) {
    const Floats t = basis.fade(cell.offset[d]);
#pragma GCC unroll 8
    for (int k = 0; k < (1 << (D - 1 - d)); ++k) value[k] = mix(value[2 * k], value[2 * k + 1], t);
  }
  return value[0];
}

}  // namespace gramloom
