#include "train/train_module.h"

#include "neural/plain_errors.h"

namespace gramloom {

namespace {

GeneratorModel run_generator(const GeneratorLesson& lesson, const Control& control,
                             const Judge& judge) {
  return neural::with_plain_errors(
      [&] { return train::run_generator_training(lesson, control, judge); });
}

InferenceModel run_inference(const InferenceLesson& lesson, const Control& control,
                             const InferenceJudge& judge) {
  return neural::with_plain_errors(
      [&] { return train::run_inference_training(lesson, control, judge); });
}

}  // namespace

extern "C" const TrainModule gramloom_train_module;
const TrainModule gramloom_train_module{run_generator, run_inference};

}  // namespace gramloom
