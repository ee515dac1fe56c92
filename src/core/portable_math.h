#pragma once

namespace gramloom::portable {

// Elementary functions whose bytes do not depend on the machine's mathematics library: they are
// built from operations that IEEE 754 rounds exactly (+ − × ÷ √), in double. Accurate to about
// 1e-15 relative (absolute for sin and cos near their zeros), far below the float results that
// textures are made of.

inline constexpr double pi = 3.14159265358979323846;

double sqrt(double x);
/// Natural logarithm, x > 0 and finite.
double log(double x);
/// 0 below −745, infinity above 709.78.
double exp(double x);
/// xʸ for x > 0, and 0ʸ = 0 for y > 0; relative error grows with |y log x| to about 1e-13.
double pow(double x, double y);
/// |x| ≤ 1e6 radians.
double sin(double x);
double cos(double x);
/// The angle of (x, y) in (−π, π]; 0 for the origin.
double atan2(double y, double x);
/// The value below which a share p of the standard normal distribution lies, 0 < p < 1; relative
/// error 1.2e-9.
double inverse_normal(double p);

}  // namespace gramloom::portable
