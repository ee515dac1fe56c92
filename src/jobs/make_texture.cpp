#include "jobs/make_texture.h"

#include <algorithm>

#include "io/json_text.h"
#include "jobs/exemplar_folder.h"
#include "jobs/input_files.h"
#include "jobs/loaded_request.h"
#include "jobs/memory.h"
#include "jobs/method_reader.h"
#include "jobs/plan.h"
#include "jobs/protected_files.h"
#include "jobs/results.h"
#include "jobs/settings.h"
#include "jobs/written_config.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* settings_mark = "gramloom:settings";

// The name of a procedural texture in place of an exemplar, or "".
std::string texture_of(const MakeWork& work) {
  const bool named = work.exemplars.size() == 1 && FileOrName(work.exemplars.front()).is_name() &&
                     !fs::exists(work.exemplars.front());
  return named ? work.exemplars.front() : "";
}

// All settings of the method in the form of --set, those that count last.
std::vector<std::string> settings_of(const MakeWork& work, const std::string& kind) {
  std::vector<std::string> set;
  if (kind == NeuralParams::kind)
    set.push_back(fmt::format("preset={}", to_word(work.preset.value_or(Preset::fast))));
  else if (work.preset)
    throw ConfigError("--preset {}: has no effect, '{}' has no presets", to_word(*work.preset),
                      kind);
  for (const std::string& option : work.set) {
    for (const std::string_view key : {"name=", "kind=", "texture="})
      if (option.starts_with(key))
        throw ConfigError("--set {}: allowed are the parameters of the method", option);
    set.push_back(option);
  }
  return set;
}

std::string method_section(const MakeWork& work, const std::string& texture) {
  const std::string kind(!work.kind.empty() ? work.kind
                         : texture.empty()  ? NeuralParams::kind
                                            : ProceduralParams::kind);
  if (!texture.empty() && kind != ProceduralParams::kind)
    throw ConfigError(
        "--kind {}: makes textures of pictures; '{}' is no file, but the name of a "
        "procedural texture",
        kind, texture);
  const std::vector<std::string> set = settings_of(work, kind);
  const Method method = method_of(kind, texture, set);
  std::string text = fmt::format("\n[[method]]\nname = {}\nkind = {}\n",
                                 quoted(texture.empty() ? kind : texture), quoted(kind));
  if (!texture.empty()) text += fmt::format("texture = {}\n", quoted(texture));
  std::vector<std::string> said;
  for (const std::string& option : set) {
    const std::string key = option.substr(0, option.find('='));
    if (std::ranges::find(said, key) != said.end()) continue;
    said.push_back(key);
    text += fmt::format("{} = {}\n", key, parameter_text(method, key));
  }
  return text;
}

// A photograph has more pixels than a texture's features need, and than one waits for.
int max_side_of(const MakeWork& work) {
  return work.max_side.value_or(std::max({1024, work.size.width, work.size.height}));
}

// Those that are named; else those that lie beside the one picture.
NamedFiles<MapFile> maps_of(const MakeWork& work) {
  const bool look = work.maps.empty() && work.finds_maps && work.exemplars.size() == 1;
  return look ? maps_beside(work.exemplars.front()) : work.maps;
}

// A procedural texture is named by itself.
void check_pictures(const MakeWork& work) {
  for (const std::string& exemplar : work.exemplars)
    if (!fs::exists(exemplar))
      throw ConfigError("there is no file {}{}", exemplar,
                        FileOrName(exemplar).is_name()
                            ? ": the name of a procedural texture stands by itself"
                            : "");
}

std::string exemplar_section(const MakeWork& work) {
  std::string text =
      fmt::format("\n[[exemplar]]\nname = {}\n", quoted(exemplar_name(work.exemplars.front())));
  if (work.exemplars.size() == 1)
    text += fmt::format("image = {}\n", quoted_path(work.exemplars.front()));
  else
    text +=
        fmt::format("images = {}\n", quoted_paths({work.exemplars.begin(), work.exemplars.end()}));
  text += fmt::format("max_side = {}\n", max_side_of(work));
  const NamedFiles<MapFile> maps = maps_of(work);
  return maps.empty() ? text : text + fmt::format("maps = {}\n", named_files_in_config(maps));
}

// The config's word for the type of that file; of none, that of most pictures.
std::string_view format_of(const fs::path& output) {
  if (output.empty()) return to_word(FileFormat::png);
  for (const std::string_view word : enum_names<FileFormat>)
    if (output.extension() == fmt::format(".{}", word) && word != to_word(FileFormat::automatic))
      return word;
  throw ConfigError("--output {}: the name must end with .png, .tif, .exr or .jpg",
                    output.string());
}

// A map that nobody has named may not fit.
Plan plan_of(const MakeWork& work, const Config& config) {
  try {
    return make_plan(config);
  } catch (const ConfigError& error) {
    if (!work.maps.empty() || maps_of(work).empty()) throw;
    throw ConfigError("{}; --no-maps leaves out what lies beside a picture", error.what());
  }
}

void check_possible(const Config& config, const Plan& plan) {
  const PlannedJob& planned = plan.jobs.front();
  const std::string refusal = !planned.error.empty()
                                  ? planned.error
                                  : memory_refusal(config, plan, planned, available_memory());
  if (!refusal.empty()) throw ConfigError("{}", refusal);
}

bool is_scaled_down(const ExemplarFacts& facts, int max_side) {
  return std::ranges::any_of(facts.request.exemplars, [&](const ExemplarSize& exemplar) {
    return std::max(exemplar.size.width, exemplar.size.height) == max_side;
  });
}

// "wall_height.png, wall_normal.png"
std::string file_names(const NamedFiles<MapFile>& maps) {
  std::string names;
  for (const auto& [name, map] : maps)
    names += (names.empty() ? "" : ", ") + map.image.filename().string();
  return names;
}

// The names of maps are ours, not the user's: they are looked at as well.
template <class Maps>
void check_files(const MakeWork& work, const Config& config, const Maps& maps) {
  try {
    check_result(work.output, config, settings_mark);
    for (const auto& [name, map] : maps)
      check_result(file_of_map(work.output, name), config, settings_mark);
  } catch (const Error& error) {
    throw ConfigError("--output {}: {}", work.output.string(), error.what());
  }
}

}  // namespace

std::string config_of(const MakeWork& work) {
  const std::string texture = texture_of(work);
  if (!texture.empty() && (work.max_side || !work.maps.empty()))
    throw ConfigError("{} is no picture but a procedural texture: it has no --map, no --max-side",
                      texture);
  if (texture.empty()) check_pictures(work);
  return fmt::format("seeds = [{}]\nsize = [{}, {}]\ntile = \"{}\"\nformat = \"{}\"\n", work.seed,
                     work.size.width, work.size.height, to_word(work.tile),
                     format_of(work.output)) +
         (texture.empty() ? exemplar_section(work) : "") + method_section(work, texture);
}

MadeFiles make_texture(const MakeWork& work, const Control& control) {
  const Config config = parse_unseen_config(config_of(work), "make");
  const Plan plan = plan_of(work, config);
  check_possible(config, plan);
  const auto maps =
      config.exemplars.empty() ? NamedFiles<MapFile>() : config.exemplars.front().maps;
  check_files(work, config, maps);
  const Job& job = plan.jobs.front().job;
  FileHashes hashes;
  const Json settings = job_settings(config, job, input_hashes(config, job, hashes));
  LoadedRequest loaded = load_request(config, job.exemplar);
  const Request request{std::move(loaded.exemplars), std::move(loaded.target),
                        Random(static_cast<std::uint64_t>(work.seed))};
  const Texture texture =
      split_layers(finished_texture(config.methods.front().method, request, control), loaded.files);
  check_files(work, config, texture.maps);
  WrittenTexture written =
      write_texture(work.output.parent_path(), work.output.stem().string(), texture,
                    output_formats(config, loaded.files, texture), settings);
  MadeFiles made{{}, std::move(loaded.notes)};
  if (!work.max_side && job.exemplar && is_scaled_down(plan.exemplars.front(), max_side_of(work)))
    made.notes.push_back(
        fmt::format("pictures are used with at most {} pixels on a side: --max-side changes that",
                    max_side_of(work)));
  if (work.maps.empty() && !maps.empty())
    made.notes.push_back(fmt::format("made with the maps beside {}: {}; --no-maps leaves them out",
                                     work.exemplars.front(), file_names(maps)));
  for (const std::string& file : written.files)
    made.files.push_back(work.output.parent_path() / file);
  std::ranges::move(written.notes, std::back_inserter(made.notes));
  return made;
}

}  // namespace gramloom
