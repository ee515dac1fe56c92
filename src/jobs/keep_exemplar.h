#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/request.h"
#include "jobs/config.h"
#include "jobs/exemplar.h"

namespace gramloom {

/// Writes what a folder keeps of an exemplar beside its results: its pictures and their maps, which
/// parts of them may be used and their guides; and of the texture the guide, the weights, what was
/// to be filled, and how the exemplar was to be laid. They are called "exemplar" + extension and
/// "exemplar_"<map> + extension in `folder`; of further pictures "exemplar_picture2" and
/// "exemplar_picture2_"<map>; "exemplar_usable.png" and "exemplar_guide.png" with the same numbers;
/// "target_guide.png", "target_weights.png", "target_mask.png", "target_angle.png",
/// "target_scale.png". Guides and weights are shown in colours, one for each label or picture;
/// angles as hues. Throws Error.
void write_exemplar(const std::filesystem::path& folder, const Request& request,
                    const std::vector<ExemplarFile>& files);

/// The names, without extension, of those files of this exemplar: of pictures and maps; and of
/// masks, guides and weights, which carry a mark that they are ours.
std::vector<std::string> kept_files(const ExemplarEntry& exemplar);
std::vector<std::string> kept_directions(const ExemplarEntry& exemplar);
bool is_kept(const std::filesystem::path& file);

}  // namespace gramloom
