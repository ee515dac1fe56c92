#include "neural/loss/multiply.h"

#include <oneapi/dnnl/dnnl.hpp>

namespace gramloom::neural {

// oneDNN writes the products; OpenBLAS, which adds them to a c that it has filled with zeros
// before, takes a third longer where c has few rows.
void multiply(char transposed, Matrix<const float> a, Matrix<const float> b, Matrix<float> c,
              std::int64_t rows, std::int64_t columns, std::int64_t inner) {
  dnnl::sgemm(transposed, 'N', rows, columns, inner, 1, a.values, a.step, b.values, b.step, 0,
              c.values, c.step);
}

void multiply(char transposed, Matrix<const double> a, Matrix<const double> b, Matrix<double> c,
              std::int64_t rows, std::int64_t columns, std::int64_t inner) {
  for (std::int64_t r = 0; r < rows; ++r)
    for (std::int64_t i = 0; i < inner; ++i) {
      const double factor = a.values[transposed == 'T' ? i * a.step + r : r * a.step + i];
      for (std::int64_t k = 0; k < columns; ++k) {
        const double product = factor * b.values[i * b.step + k];
        double& sum = c.values[r * c.step + k];
        sum = i == 0 ? product : sum + product;
      }
    }
}

}  // namespace gramloom::neural
