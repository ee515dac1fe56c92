#include "neural/module.h"

#include "neural/plain_errors.h"

namespace gramloom {

namespace {

Texture run(const NeuralParams& params, const Request& request, const Control& control,
            const neural::Group& group) {
  return neural::with_plain_errors(
      [&] { return neural::run_synthesis(params, request, control, group); });
}

}  // namespace

extern "C" const NeuralModule gramloom_neural_module;
const NeuralModule gramloom_neural_module{run, neural::join_group, neural::measure_blas,
                                          neural::measure_operations};

}  // namespace gramloom
