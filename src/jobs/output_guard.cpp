#include "jobs/output_guard.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "io/image_file.h"
#include "jobs/keep_exemplar.h"
#include "jobs/protected_files.h"
#include "runs/file_lock.h"
#include "runs/job_files.h"
#include "runs/own_files.h"
#include "runs/record.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool contains(const auto& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

[[noreturn]] void refuse_file_of_others(const fs::path& file) {
  throw Error("would replace {}, which no run of gramloom made", file.lexically_normal().string());
}

// The pictures that results have, of all formats.
constexpr auto picture_extensions =
    std::to_array<std::string_view>({".png", ".tif", ".exr", ".jpg"});

bool made_by_us(const fs::path& picture) {
  try {
    std::error_code ignored;
    return fs::is_regular_file(picture, ignored) &&
           read_image(picture).metadata.contains("gramloom:settings");
  } catch (const Error&) {
    return false;
  }
}

// The maps that a trained model makes besides its picture; of one that cannot be read, none.
std::vector<std::string> maps_of_model(const Method& method) {
  std::vector<std::string> names;
  const auto* generator = std::get_if<GeneratorParams>(&method);
  if (!generator) return names;
  try {
    for (const GeneratorLayer& layer : read_generator_description(model_file(*generator)).layers)
      names.push_back(layer.name);
  } catch (const Error&) {
  }
  return names;
}

// Looks at one file after the other that a run is going to write or remove.
class Guard {
 public:
  Guard(const Config& config, const fs::path& output, const std::vector<InputFile>& inputs)
      : config_(config), output_(output), before_(earlier_run_in(output)), inputs_(inputs) {}

  void check_files_of_run() const {
    check(output_ / "run.json", [&](const fs::path&) { return before_.is_ours; });
    check(output_ / "scores.csv", is_score_sheet);
    check(output_ / "index.html", is_page);
    check(output_ / "baseline.json", is_comparison);
    check(output_ / "run.lock", is_lock);
  }

  // "exemplar.png" and "exemplar_height.png" beside the folders of the exemplar's jobs.
  void check_exemplar(const ExemplarEntry& exemplar) const {
    const fs::path folder = output_ / exemplar.name;
    const bool ours =
        (before_.is_ours && before_.folders.contains(exemplar.name)) || holds_record(folder);
    for (const std::string& stem : kept_files(exemplar))
      for (const std::string extension : {".png", ".tif", ".exr"})
        check(folder / (stem + extension), [&](const fs::path&) { return ours; });
    for (const std::string& stem : kept_directions(exemplar))
      check(folder / (stem + ".png"), is_kept);
  }

  void check_job(const PlannedJob& planned) {
    const JobFiles files = job_files(output_, planned.name);
    if (folder_ != files.folder) {
      folder_ = files.folder;
      names_ = names_in(folder_);
    }
    check(files.lock, is_lock);
    check(files.folder / "diversity.json", is_diversity);
    const auto is_map = map_names(planned.job);
    std::optional<std::optional<JobRecord>> record;  // read when there is a file to ask about
    for (auto name = std::lower_bound(names_.begin(), names_.end(), files.name);
         name != names_.end() && name->starts_with(files.name); ++name) {
      const std::string rest = name->substr(files.name.size());
      if (!rest.starts_with('.') && !rest.starts_with('_')) continue;  // seed1 and seed10
      if (!record) record = find_record(files.record);
      const bool listed = *record && contains((*record)->files, *name);
      const bool picture = is_picture(rest, is_map);
      if (!listed && !picture && !is_own_name(rest)) continue;  // it stays as it is
      const bool known = *record || (before_.is_ours && before_.begun.contains(planned.name));
      check(folder_ / *name, [&](const fs::path& file) {
        return known && ((listed && !fs::is_directory(file)) || !picture || made_by_us(file));
      });
    }
  }

 private:
  void check(const fs::path& file, const auto& is_ours) const {
    if (!is_there(file)) return;
    inputs_.check(file);
    if (!is_ours(file)) refuse_file_of_others(file);
  }

  // Of the texture and its maps.
  static bool is_picture(const std::string& rest, const auto& is_map) {
    const std::size_t dot = rest.rfind('.');
    if (dot == std::string::npos || !contains(picture_extensions, rest.substr(dot))) return false;
    return dot == 0 || (rest.front() == '_' && is_map(rest.substr(1, dot - 1)));
  }

  static bool is_own_name(const std::string& rest) {
    constexpr auto names = std::to_array<std::string_view>(
        {".json", ".csv", ".copy_map.png", ".checkpoint", ".checkpoint.csv"});
    return contains(names, rest);
  }

  // Which maps the job's texture has: the exemplar's, or those that procedural textures know; and
  // those made of its height.
  std::function<bool(const std::string&)> map_names(const Job& job) const {
    std::vector<std::string> made = maps_asked(config_.surface);
    if (config_.surface.guess) made.insert(made.end(), {"height", "roughness"});
    if (config_.coordinates) made.emplace_back("coordinates");
    for (const PreviewEntry& preview : config_.previews) made.push_back(label_of(preview));
    if (job.exemplar)
      return [&maps = config_.exemplars[*job.exemplar].maps, made](const std::string& name) {
        return maps.contains(name) || contains(made, name);
      };
    for (const std::string& name : maps_of_model(config_.methods[job.method].method))
      made.push_back(name);
    return [made](const std::string& name) {
      return name == "height" || name == "mask" || name.starts_with("frame_") ||
             contains(made, name);
    };
  }

  // Whether a job of an earlier run has left its record in a folder below.
  static bool holds_record(const fs::path& folder) {
    std::error_code ignored;
    for (const auto& method : fs::directory_iterator(folder, ignored))
      for (const auto& entry : fs::directory_iterator(method.path(), ignored))
        if (entry.path().extension() == ".json" && find_record(entry.path())) return true;
    return false;
  }

  const Config& config_;
  const fs::path& output_;
  EarlierRun before_;
  ProtectedFiles inputs_;
  fs::path folder_;  // of the last job, and what is in it
  std::vector<std::string> names_;
};

}  // namespace

void check_output(const Config& config, const Plan& plan, const fs::path& output,
                  const std::vector<InputFile>& inputs) {
  Guard guard(config, output, inputs);
  guard.check_files_of_run();
  std::optional<std::size_t> exemplar;
  for (const PlannedJob& planned : plan.jobs) {
    if (!planned.selected) continue;
    if (planned.job.exemplar && planned.job.exemplar != exemplar)
      guard.check_exemplar(config.exemplars[*planned.job.exemplar]);
    exemplar = planned.job.exemplar;
    guard.check_job(planned);
  }
}

void check_default_output(const Config& config, const fs::path& output) {
  const EarlierRun before = earlier_run_in(output);
  if (!before.is_ours || before.config.empty()) return;
  // The folder is out/NAME below the one that the earlier run was called from.
  const fs::path called_from = fs::absolute(output).parent_path().parent_path();
  const auto place = [&](const fs::path& file) {
    const fs::path whole = (called_from / file).lexically_normal();
    std::error_code ignored;
    return fs::weakly_canonical(whole.parent_path(), ignored) / whole.filename();
  };
  const fs::path other = place(before.config);
  const bool has_it_too = other.stem() == config.file.stem();  // else the user has named it
  if (!has_it_too || other == place(config.file) || !is_there(other)) return;
  throw Error("holds the results of {}; choose another folder for those of {}", before.config,
              config.file.string());
}

fs::path default_output(const Config& config) { return fs::path("out") / config.file.stem(); }

void check_page(const fs::path& folder) {
  const fs::path page = folder / "index.html";
  if (is_there(page) && !is_page(page)) refuse_file_of_others(page);
}

}  // namespace gramloom
