#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "surface/preview_params.h"

namespace gramloom {

struct Config;
struct Job;

/// A picture of results on a shape: the [preview] of a config, or one of its [[preview]].
struct PreviewEntry : PreviewParams {
  std::string name;  // fit for a file's name; "" of at most one
  std::string only;
  FileOrName second;
  std::string place;  // where the config says so, for messages

  static constexpr auto fields() {
    using E = PreviewEntry;
    return std::tuple_cat(
        std::tuple{Field{"name", &E::name,
                         "yours to choose, where there are several: seed1_preview_NAME.png"},
                   Field{"only", &E::only,
                         "jobs that it is made of, as --only says them; all if not set"}},
        PreviewParams::fields(),
        std::tuple{Field{"second", &E::second,
                         "a second material, that shares the shape with the result by the pattern: "
                         "a procedural texture, or a picture, with its maps beside it"}});
  }
};

/// What the file of a preview is called behind the job: "preview", "preview_NAME".
std::string label_of(const PreviewEntry& preview);
/// For messages: "preview", "preview 'NAME'".
std::string title_of(const PreviewEntry& preview);

/// The previews that a config asks for. Fails for what does not fit together: two of one name, keys
/// without effect.
std::vector<PreviewEntry> read_previews(toml::table& config);

/// Those that are made of the job's texture.
std::vector<const PreviewEntry*> previews_of(const Config& config, const Job& job);

}  // namespace gramloom
