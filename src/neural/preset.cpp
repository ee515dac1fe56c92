#include "neural/params.h"

namespace gramloom {

NeuralParams with_preset(Preset preset) {
  NeuralParams params;  // balanced
  params.preset = preset;
  switch (preset) {
    case Preset::balanced:
      break;
    case Preset::fast:
      params.directions = 24;
      params.spectrum_weight = 0;
      params.iterations = {30, 60, 120, 150};
      params.flow_steps = {4, 6, 12};
      break;
    case Preset::quality:
      params.directions = 64;
      params.iterations = {240, 360, 600};
      break;
    case Preset::gatys:
      params.layout = Layout::noise;
      params.sliced_weight = 0;
      params.spectrum_weight = 0;
      params.gram_weight = 1;
      params.whitening = 1;
      params.optimizer = {Optimizer::lbfgs};
      params.iterations = {200};
      params.learning_rate = 0.03;
      params.levels = 1;
      params.level_factor = 0.5;
      break;
  }
  return params;
}

}  // namespace gramloom
