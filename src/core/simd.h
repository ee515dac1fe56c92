#pragma once

/// Compiles a hot function for several x86-64 levels; the program picks the best at start. The
/// bytes are the same for all, since -ffp-contract=off forbids fused multiply-add. What such a
/// function calls must be inlined into it. Empty under the sanitizers, which break its resolver.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GRAMLOOM_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define GRAMLOOM_SIMD
#endif

/// For what a GRAMLOOM_SIMD function calls.
#define GRAMLOOM_INLINE inline __attribute__((always_inline))
