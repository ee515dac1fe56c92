#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "core/fields.h"

namespace gramloom {

/// What `check` says of a job, of the comparison of some, or of a model to train.
struct Expectation {
  std::string name;
  std::optional<double> memory;   // bytes of the whole process
  std::optional<double> seconds;  // on this machine
  std::string problem;            // what keeps it from being done; "": nothing

  static constexpr auto fields() {
    using E = Expectation;
    return std::tuple{
        Field{"name", &E::name, "of the job"},
        Field{"memory", &E::memory, "peak of the process", "bytes"},
        Field{"seconds", &E::seconds, "on this machine", "s"},
        Field{"problem", &E::problem, "what keeps it from being done"},
    };
  }
};

}  // namespace gramloom
