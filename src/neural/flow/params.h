#pragma once

#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// Settings of patch flow matching (flow/patch_flow.h). Lists are read from the finest octave on;
/// the last value also holds for all coarser ones.
struct FlowParams {
  int flow_octaves = 3;
  std::vector<int> flow_patch_sizes{8, 8, 12};
  std::vector<int> flow_steps{10, 12, 24};
  std::vector<double> flow_renoise{0.75, 0.6};
  std::vector<int> flow_neighbours{3, 4, 4};
  int flow_references = 2500;
  double flow_price = 0.2;

  static constexpr auto fields() {
    using P = FlowParams;
    return std::tuple{
        Field{"flow_octaves",
              &P::flow_octaves,
              "sizes of the picture, each half the next, on which the layout is made",
              "",
              {1, 8}},
        Field{"flow_patch_sizes",
              &P::flow_patch_sizes,
              "sides of the layout's patches; lists are read from the finest octave on, and the "
              "last value is also for all coarser ones",
              "pixels",
              {2, 32}},
        Field{"flow_steps",
              &P::flow_steps,
              "steps from noise to picture on each octave",
              "",
              {1, 1000}},
        Field{"flow_renoise",
              &P::flow_renoise,
              "how much of the coarser octave's picture an octave starts from; the rest is noise",
              "",
              {0, 0.99}},
        Field{"flow_neighbours",
              &P::flow_neighbours,
              "exemplar patches that each patch becomes a mean of",
              "",
              {1, 64}},
        Field{"flow_references",
              &P::flow_references,
              "exemplar patches, drawn anew for each step, among which neighbours are looked for",
              "",
              {16, 1000000}},
        Field{"flow_price",
              &P::flow_price,
              "how fast an exemplar patch that is used too often becomes dearer; 0: never",
              "",
              {0, 10}}};
  }
};

}  // namespace gramloom
