#include "train/train_module.h"

#include <c10/util/Exception.h>

#include <new>
#include <string>

#include "core/error.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

// LibTorch's errors are several lines that begin with a place in its source.
template <class Work>
auto with_plain_errors(Work&& work) {
  try {
    return work();
  } catch (const c10::Error& error) {
    const std::string text = error.what_without_backtrace();
    if (text.find("allocate memory") != std::string::npos) throw std::bad_alloc();
    throw Error("LibTorch: {}", first_line(text));
  }
}

GeneratorModel run_generator(const GeneratorLesson& lesson, const Control& control,
                             const Judge& judge) {
  return with_plain_errors([&] { return train::run_generator_training(lesson, control, judge); });
}

InferenceModel run_inference(const InferenceLesson& lesson, const Control& control,
                             const InferenceJudge& judge) {
  return with_plain_errors([&] { return train::run_inference_training(lesson, control, judge); });
}

}  // namespace

extern "C" const TrainModule gramloom_train_module;
const TrainModule gramloom_train_module{run_generator, run_inference};

}  // namespace gramloom
