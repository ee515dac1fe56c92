#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"

namespace gramloom {

/// One term of a loss, by the name it has in the trace.
struct Term {
  std::string name;
  double value = 0;
};

/// How far a synthesis is. Steps are whatever the method counts: iterations, rows, patches.
struct Progress {
  std::int64_t step = 0;
  std::int64_t steps = 0;
  /// Iterative methods only: evaluations of the loss since the start, the loss and its terms.
  std::int64_t evaluations = 0;
  double loss = std::numeric_limits<double>::quiet_NaN();
  std::vector<Term> terms;
};

/// What a caller gives to long work: where to report, and where to keep unfinished state.
struct Control {
  /// Called from the thread that called the method, at least a few times a second where the work
  /// allows it. Returning false asks the work to stop.
  std::function<bool(const Progress&)> progress;
  /// Iterative methods save their state here when they stop early or every minute, and go on from
  /// it if it exists; empty: nowhere.
  std::filesystem::path checkpoint;
  /// Everything that the result depends on, as one text (a hash of it, say). It is kept with the
  /// state, and a state with another one is not gone on from: equal texts promise equal work.
  std::string identity;

  /// Reports; false when the work should stop.
  bool report(const Progress& p) const { return !progress || progress(p); }
  /// Reports a step of work that leaves nothing to keep when it stops. Throws Interrupted.
  void step(std::int64_t step, std::int64_t steps) const {
    Progress p;
    p.step = step;
    p.steps = steps;
    if (!report(p)) throw Interrupted();
  }
};

}  // namespace gramloom
