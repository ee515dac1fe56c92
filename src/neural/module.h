#pragma once

#include <string_view>

#include "neural/synthesis.h"

namespace gramloom {

/// What of neural/ needs LibTorch, and so lies in a module (core/modules.h): all but parameters,
/// presets, network descriptions, levels and costs.
struct NeuralModule {
  static constexpr std::string_view name = "neural";
  Texture (*synthesise)(const NeuralParams& params, const Request& request, const Control& control);
  double (*blas_gigaflops)();
  double (*operations_per_second)();
};

namespace neural {
Texture run_synthesis(const NeuralParams& params, const Request& request, const Control& control);
double measure_blas();
double measure_operations();
}  // namespace neural

}  // namespace gramloom
