#pragma once

#include <vector>

#include "core/request.h"
#include "jobs/config.h"

namespace gramloom {

/// Makes guides of the exemplars' guides, as these `files` are, and of the target's, which is read:
/// a channel for each label, or values of total variance 1 in the exemplars; and weighs them.
/// Throws ConfigError for guides of different numbers of channels, for one of another size than the
/// texture, and for a label of the target that no exemplar has where it may be used.
void add_guides(const Config& config, const std::vector<std::filesystem::path>& files,
                std::vector<Exemplar>& exemplars, Target& target);

}  // namespace gramloom
