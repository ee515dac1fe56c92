#pragma once

#include <cstdint>

namespace gramloom::neural {

/// Row-major, `step` values from row to row.
template <class T>
struct Matrix {
  T* values;
  std::int64_t step;
};

/// c = a · b, or aᵀ · b where `transposed` is 'T' and not 'N'; a has `inner` columns, or rows, c
/// has `rows` × `columns`. To be called with an InThisThread (neural/openmp.h) about.
void multiply(char transposed, Matrix<const float> a, Matrix<const float> b, Matrix<float> c,
              std::int64_t rows, std::int64_t columns, std::int64_t inner);
void multiply(char transposed, Matrix<const double> a, Matrix<const double> b, Matrix<double> c,
              std::int64_t rows, std::int64_t columns, std::int64_t inner);

}  // namespace gramloom::neural
