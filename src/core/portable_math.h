#pragma once

namespace gramloom::portable {

// Elementary functions whose bytes do not depend on the machine's mathematics library: they are
// built from operations that IEEE 754 rounds exactly (+ − × ÷ √), in double. Accurate to about
// 1e-15 relative (absolute for sin and cos near their zeros), far below the float results that
// textures are made of.

double sqrt(double x);
/// Natural logarithm, x > 0 and finite.
double log(double x);

}  // namespace gramloom::portable
