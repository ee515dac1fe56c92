#include "runs/run_folder.h"

#include <algorithm>

#include "runs/format.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// "pebbles", "quilting" and "seed1". Nobody's run.json leads out of its folder.
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (const auto& part : fs::path(name)) parts.push_back(part.string());
  const bool fit = parts.size() == 3 && parts[2].starts_with("seed") &&
                   std::none_of(parts.begin(), parts.end(),
                                [](const auto& part) { return part.empty() || part[0] == '.'; });
  if (!fit || fs::path(name).is_absolute()) throw Error("'{}' is no job's name", name);
  return parts;
}

int seed_of(const std::string& part) {
  try {
    return std::stoi(part.substr(std::string_view("seed").size()));
  } catch (const std::exception&) {
    throw Error("'{}' names no seed", part);
  }
}

// What stands for a record that is not there: the state that run.json knows.
JobRecord placeholder(const std::string& name, const JobStanding& standing) {
  const auto parts = parts_of(name);
  JobRecord record;
  record.exemplar = parts[0];
  record.method = parts[1];
  record.seed = seed_of(parts[2]);
  record.status = standing.status;
  record.error = standing.error;
  return record;
}

Trace read_trace(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return {};
  try {
    return parse_trace(read_text(file));
  } catch (const Error& error) {
    throw Error("{}: {}", file.string(), error.what());
  }
}

JobOnDisk read_job(const fs::path& folder, const std::string& name, const JobStanding& standing) {
  const JobFiles files = job_files(folder, name);
  JobOnDisk job{name, placeholder(name, standing), {}};
  std::error_code ignored;
  if (!fs::exists(files.record, ignored)) return job;
  try {
    JobRecord record = read_record(files.record);
    job.trace = read_trace(files.trace);
    job.record = std::move(record);
  } catch (const Error& error) {
    job.record.status = Status::failed;
    job.record.error = error.what();
  }
  return job;
}

}  // namespace

RunOnDisk read_run(const fs::path& folder) {
  const fs::path file = folder / "run.json";
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw Error("{}: there is no run.json, so this is not the folder of a run", folder.string());
  RunOnDisk run{folder, read_format<RunRecord>(file), {}, {}};
  std::vector<NamedRecord> records;
  for (const auto& [name, standing] : run.run.jobs) {
    try {
      run.jobs.push_back(read_job(folder, name, standing));
    } catch (const Error& error) {
      throw Error("{}: {}", file.string(), error.what());
    }
    records.push_back({name, run.jobs.back().record});
  }
  run.diversity = valid_diversity(find_diversity(folder, records, run.run.diversity), records);
  return run;
}

RunOnDisk read_named_run(const fs::path& folder) {
  try {
    return read_run(folder);
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
}

}  // namespace gramloom
