#pragma once

#include <string_view>

#include "train/generator_training.h"
#include "train/inference_training.h"

namespace gramloom {

/// What of train/ needs LibTorch, and so lies in a module (core/modules.h).
struct TrainModule {
  static constexpr std::string_view name = "train";
  GeneratorModel (*train_generator)(const GeneratorLesson& lesson, const Control& control,
                                    const Judge& judge);
  InferenceModel (*train_inference)(const InferenceLesson& lesson, const Control& control,
                                    const InferenceJudge& judge);
};

namespace train {
GeneratorModel run_generator_training(const GeneratorLesson& lesson, const Control& control,
                                      const Judge& judge);
InferenceModel run_inference_training(const InferenceLesson& lesson, const Control& control,
                                      const InferenceJudge& judge);
}  // namespace train

}  // namespace gramloom
