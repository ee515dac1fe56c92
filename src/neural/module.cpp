#include "neural/module.h"

#include "neural/plain_errors.h"

namespace gramloom {

namespace {

Texture run(const NeuralParams& params, const Request& request, const Control& control) {
  return neural::with_plain_errors([&] { return neural::run_synthesis(params, request, control); });
}

}  // namespace

extern "C" const NeuralModule gramloom_neural_module;
const NeuralModule gramloom_neural_module{run, neural::measure_blas, neural::measure_operations};

}  // namespace gramloom
