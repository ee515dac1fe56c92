#pragma once

namespace gramloom {

/// Speed of a single-precision matrix product with one thread, in 10⁹ operations a second: about 6
/// with the reference BLAS that Debian installs by default, 50 and more with OpenBLAS. Takes some
/// milliseconds.
double blas_gigaflops();

/// Operations a second that large single-precision matrix products reach with all threads. Takes a
/// third of a second.
double operations_per_second();

/// Below this the BLAS is the reference one, and syntheses take several times as long.
inline constexpr double slow_blas_gigaflops = 15;

}  // namespace gramloom
