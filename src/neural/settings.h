#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "core/request.h"
#include "io/safetensors.h"
#include "neural/network/work.h"
#include "neural/params.h"

namespace gramloom::neural {

/// The value of a list for a level, 0 being the finest: the last one serves all coarser levels.
template <class T>
const T& at_level(const std::vector<T>& list, int level) {
  return list[std::min(static_cast<std::size_t>(level), list.size() - 1)];
}

/// What `layout` is for pictures of these sizes, unless the exemplar's look says otherwise:
/// automatic is flow for two octaves or more of an exemplar of at least 48 pixels each, where
/// patches are matched, and neither levels nor a picture to start from are given.
Layout layout_by_size(const NeuralParams& params, Size exemplar, const Target& target);

/// Levels of the pyramid. Chosen by coarsest_side, they end where a patch would no longer fit into
/// the exemplar or, on an axis that does not tile, the result.
int level_count(const NeuralParams& params, Size exemplar, const Target& target);
/// The size of a picture on a level.
Size level_size(const NeuralParams& params, Size whole, int level);
/// The size that is worked on: on an axis that does not tile, a little more than the texture's, to
/// be cut off at the end. Pixels at an edge lie in few patches and stay rough. Not of a fill: of an
/// exemplar that is the picture itself levels then have the same pixels.
Size canvas_size(const NeuralParams& params, const Target& target);
/// Whether a fill looks at its holes and what is around them alone, not at the whole picture: where
/// that is less than most of it. A picture to start from is of the whole, and so many levels as are
/// asked for may need it.
bool fills_window(const NeuralParams& params, const RequestSize& request);
/// Whether several processes share the picture of a level, each its rows. A small one each makes
/// alone, and so the same: of the others a step compares a random part of the patches
/// (loss/sliced.h), which is the same however it is shared.
bool is_shared(const NeuralParams& params, Size level, int processes);
/// Steps of all levels but those finer than `level`.
std::int64_t steps_down_to(const NeuralParams& params, int levels, int level);

/// Throws ConfigError for what the field list alone cannot tell: empty lists, no term at all.
void check_settings(const NeuralParams& params);

/// The layers that `params` asks for with their weights, in the network's order; `description`
/// loses the layers above the last of them, which would be computed for nothing. Throws ConfigError
/// for an unknown layer, or weights that are not one for each layer.
std::vector<MatchedLayer> matched_layers(const NeuralParams& params,
                                         NetworkDescription& description);

/// Throws Error when the coarsest level of the exemplar or of the result is too small for the
/// patches or for a layer of the network (none: not needed).
void check_levels(const NeuralParams& params, const NetworkDescription* network, Size exemplar,
                  const Target& target);

/// The picture to start from. Throws Error when it cannot be read or has other channels.
Image read_start(const NeuralParams& params, int channels);

/// Throws Error when trained weights are for another number of channels, ConfigError when there is
/// no such file.
void check_weights(const NeuralParams& params, const NetworkDescription& description, int channels);

/// Trained weights for these filters by the names that they have in the file, each of its shape and
/// of finite numbers. Throws Error with file and tensor.
std::map<std::string, TensorData> read_weights(const NetworkDescription& description,
                                               const std::vector<FilterShape>& shapes,
                                               const std::filesystem::path& file);
/// torchvision's names of a layer's tensors.
std::string weight_name(std::size_t layer);
std::string bias_name(std::size_t layer);

}  // namespace gramloom::neural
