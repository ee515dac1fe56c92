#include "report/baseline_view.h"

#include "core/error.h"
#include "core/hash.h"
#include "io/field_values.h"
#include "io/text_file.h"
#include "report/preview.h"
#include "runs/format.h"
#include "runs/job_files.h"
#include "runs/job_maps.h"
#include "runs/own_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

bool has_content(const fs::path& file, const std::string& hash) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && hash_of(read_text(file)) == hash;
}

// A second name where the disk can, which a later run into the earlier folder leaves alone; else a
// copy.
void keep(const fs::path& file, const fs::path& copy) {
  create_folder(copy.parent_path());
  remove_file(copy);
  std::error_code failure;
  fs::create_hard_link(file, copy, failure);
  if (failure) write_text(copy, read_text(file));
}

// The earlier picture, from the run's folder on; "" where it is gone.
std::string kept_before(const RunOnDisk& run, const ComparisonRecord& comparison,
                        const ChangedPicture& picture) {
  const fs::path path = fs::path(picture.before).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == "..")
    throw Error("baseline.json: {} is elsewhere", picture.before);
  const fs::path kept = fs::path("page") / "before" / path;
  if (!has_content(run.folder / kept, picture.before_hash)) {
    const fs::path there = run.folder / comparison.folder / path;
    if (!has_content(there, picture.before_hash)) return "";
    keep(there, run.folder / kept);
  }
  return kept.generic_string();
}

}  // namespace

std::optional<ComparisonRecord> read_comparison(const RunOnDisk& run, Json& trouble) {
  const fs::path file = run.folder / "baseline.json";
  if (!is_comparison(file)) return std::nullopt;
  try {
    return read_format<ComparisonRecord>(file);
  } catch (const Error& error) {
    trouble.push_back(error.what());
    return std::nullopt;
  }
}

Json baseline_summary(const ComparisonRecord& comparison) {
  return {{"folder", comparison.baseline},  {"limits", to_json_value(comparison.limits)},
          {"worse", comparison.worse},      {"changes", to_json_value(comparison.changes)},
          {"jobs", comparison.jobs.size()}, {"old", comparison.folder.empty()}};
}

Json baseline_job(const RunOnDisk& run, const ComparisonRecord& comparison, const ChangedJob& job,
                  const std::function<double(const std::string&)>& white, Json& trouble) {
  Json pictures = Json::array();
  for (const ChangedPicture& picture : job.pictures) {
    const std::string label = label_of_file(job.job, picture.now);
    try {
      const std::string kept = kept_before(run, comparison, picture);
      pictures.push_back(
          {{"label", label},
           {"before", kept.empty() ? Json() : Json(shown_file(run.folder, kept, white(label)))},
           {"was", (fs::path(comparison.baseline) / picture.before).generic_string()}});
    } catch (const std::exception& error) {
      trouble.push_back(message_of(error));
    }
  }
  return {{"scores", to_json_value(job.scores)}, {"pictures", pictures}};
}

}  // namespace gramloom
