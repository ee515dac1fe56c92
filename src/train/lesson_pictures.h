#pragma once

#include <torch/torch.h>

#include <vector>

#include "train/colour_axes.h"
#include "train/generator_training.h"

namespace gramloom::train {

/// The exemplars as the networks see them: a pyramid each, the coarsest level first, (1, channels,
/// height, width) along the axes, each level the means of 2×2 pixels of the next.
struct LessonPictures {
  ColourAxes axes;
  std::vector<std::vector<at::Tensor>> pyramids;
};
LessonPictures lesson_pictures(const GeneratorLesson& lesson, int levels);

/// `colours.…` of the model that learns them.
void add_colours(const LessonPictures& pictures, const std::vector<Image>& exemplars,
                 GeneratorModel& model);

}  // namespace gramloom::train
