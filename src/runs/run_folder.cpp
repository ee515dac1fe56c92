#include "runs/run_folder.h"

#include <algorithm>

#include "core/error.h"
#include "io/text_file.h"

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
Json placeholder(const std::string& name, const Json& state, const std::string& error) {
  const auto parts = parts_of(name);
  return {{"exemplar", parts[0]},
          {"method", parts[1]},
          {"seed", seed_of(parts[2])},
          {"status", error.empty() ? state.value("status", "waiting") : "failed"},
          {"error", error.empty() ? state.value("error", "") : error}};
}

void check_record(const Json& record) {
  for (const auto* key : {"exemplar", "method", "status", "error"})
    if (!record.at(key).is_string()) throw Error("'{}' is not a text", key);
  if (!record.at("seed").is_number_integer()) throw Error("'seed' is not a whole number");
}

Trace read_trace(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return {};
  return parse_trace(read_text(file));
}

JobOnDisk read_job(const fs::path& folder, const std::string& name, const Json& state) {
  const fs::path file = folder / (name + ".json");
  JobOnDisk job{name, placeholder(name, state, ""), {}};
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return job;
  try {
    Json record = Json::parse(read_text(file));
    check_record(record);
    job.record = std::move(record);
    job.trace = read_trace(folder / (name + ".csv"));
  } catch (const std::exception& error) {
    job.record = placeholder(name, state, fmt::format("its files: {}", error.what()));
  }
  return job;
}

}  // namespace

RunOnDisk read_run(const fs::path& folder) {
  const fs::path file = folder / "run.json";
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw Error("{}: there is no run.json, so this is not the folder of a run", folder.string());
  RunOnDisk run{folder, {}, {}};
  try {
    run.run = Json::parse(read_text(file));
    for (const auto& [name, state] : run.run.at("jobs").items())
      run.jobs.push_back(read_job(folder, name, state));
  } catch (const Json::exception&) {
    throw Error("{}: is not a run's", file.string());
  } catch (const Error& error) {
    throw Error("{}: {}", file.string(), error.what());
  }
  return run;
}

}  // namespace gramloom
