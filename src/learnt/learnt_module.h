#pragma once

#include <string_view>

#include "learnt/generator.h"

namespace gramloom {

/// What of learnt/ needs oneDNN, and so lies in a module (core/modules.h).
struct LearntModule {
  static constexpr std::string_view name = "learnt";
  void (*generate)(const GeneratorModel& model, const Generation& wanted, const WriteRows& write,
                   const Control& control);
};

}  // namespace gramloom
