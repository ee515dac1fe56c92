#include "neural/module.h"

#include <c10/util/Exception.h>

#include <new>
#include <string>

#include "core/error.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

// LibTorch's errors are several lines that begin with a place in its source.
[[noreturn]] void rethrow(const c10::Error& error) {
  const std::string text = error.what_without_backtrace();
  if (text.find("allocate memory") != std::string::npos) throw std::bad_alloc();
  throw Error("LibTorch: {}", first_line(text));
}

Texture run(const NeuralParams& params, const Request& request, const Control& control) {
  try {
    return neural::run_synthesis(params, request, control);
  } catch (const c10::Error& error) {
    rethrow(error);
  }
}

}  // namespace

extern "C" const NeuralModule gramloom_neural_module;
const NeuralModule gramloom_neural_module{run, neural::measure_blas};

}  // namespace gramloom
