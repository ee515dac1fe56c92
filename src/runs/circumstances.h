#pragma once

#include <limits>
#include <string>
#include <tuple>

#include "core/fields.h"

namespace gramloom {

/// Where something ran. Results of neural methods depend on it in their last bits, no others.
struct Machine {
  std::string processor;
  int cores = 0;
  int threads = 0;  // in use; 0: not known
  std::string memory;

  friend bool operator==(const Machine&, const Machine&) = default;

  static constexpr auto fields() {
    using M = Machine;
    return std::tuple{
        Field{"processor", &M::processor, "its name"},
        Field{"cores", &M::cores, "of the machine", "", {0, 1e9}},
        Field{"threads", &M::threads, "in use", "", {0, 1e9}},
        Field{"memory", &M::memory, "of the machine"},
    };
  }
};

}  // namespace gramloom
