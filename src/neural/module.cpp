#include "neural/module.h"

namespace gramloom {

extern "C" const NeuralModule gramloom_neural_module;
const NeuralModule gramloom_neural_module{neural::run_synthesis, neural::measure_blas};

}  // namespace gramloom
