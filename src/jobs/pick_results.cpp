#include "jobs/pick_results.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/hash.h"
#include "io/json_fields.h"
#include "io/text_file.h"
#include "jobs/inputs.h"
#include "jobs/job_config.h"
#include "jobs/machine.h"
#include "jobs/marked_folder.h"
#include "jobs/settings.h"
#include "jobs/training.h"
#include "runs/job_files.h"
#include "runs/run_folder.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* picked_mark = "picked.json";

// A picture and its maps, and the config that makes them.
struct Pick {
  std::string job;
  std::vector<std::string> files;  // from the run's folder on; the texture is the first
  std::string config;
};

std::vector<std::string> names_of(const PickWork& work) {
  std::vector<std::string> names = work.names;
  if (!work.list.empty()) {
    std::istringstream lines(read_text(work.list));
    for (std::string line; std::getline(lines, line);) {
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
      if (!line.empty()) names.push_back(line);
    }
  }
  std::vector<std::string> different;
  std::set<std::string> known;
  for (const std::string& name : names)
    if (known.insert(name).second) different.push_back(name);
  if (different.empty()) throw Error("no picture is named");
  return different;
}

const JobOnDisk& find_job(const RunOnDisk& run, const std::string& name) {
  const auto found = std::ranges::find(run.jobs, name, &JobOnDisk::name);
  if (found == run.jobs.end()) {
    std::vector<std::string> names;
    for (const JobOnDisk& job : run.jobs) names.push_back(job.name);
    const std::string guess = closest_word(name, names);
    throw Error("no job of it is called '{}'{}", name,
                guess.empty() ? "" : fmt::format(" (did you mean '{}'?)", guess));
  }
  if (found->record.status != Status::done)
    throw Error("{} is not finished ({})", name, to_word(found->record.status));
  if (!is_finished(found->record, (run.folder / name).parent_path()))
    throw Error("{}: its pictures are no longer there", name);
  return *found;
}

// The config that jobs were made by. Where it lies is known from the folder that the run was called
// from, which nothing says: so that and the folders around the results are tried.
class Origin {
 public:
  explicit Origin(const RunOnDisk& run) : run_(run) {
    folders_.emplace_back("");
    fs::path folder = fs::absolute(run.folder).lexically_normal();
    for (; folder != folder.root_path(); folder = folder.parent_path())
      folders_.push_back(folder.parent_path());
  }

  // Throws Error where none of them makes the same.
  std::string config_of(const JobOnDisk& job) {
    std::string why;
    for (const fs::path& folder : folders_) {
      try {
        return config_in(folder, job);
      } catch (const Error& error) {
        if (why.empty()) why = error.what();
      }
    }
    throw Error("{}: {}", job.name, why);
  }

 private:
  struct Read {
    std::vector<std::string> set;
    std::optional<Config> config;  // none: why not
    std::map<std::string, Job> jobs;
    std::string error;
  };

  const Read& read(const fs::path& folder, const std::vector<std::string>& set) {
    std::vector<Read>& known = read_[folder];
    auto found = std::ranges::find(known, set, &Read::set);
    if (found == known.end()) {
      found = known.insert(known.end(), {set, {}, {}, {}});
      try {
        const Config config = parse_config(run_.run.config_text, folder / run_.run.config, set);
        found->config =
            textures_of_trained(config, {0, false, trained_methods(config, run_.folder)}, "");
        if (!found->config) throw Error("its config makes no textures");
        found->jobs = jobs_of(*found->config);
      } catch (const Error& error) {
        found->error = error.what();
      }
    }
    if (!found->error.empty()) throw Error("{}", found->error);
    return *found;
  }

  static std::map<std::string, Job> jobs_of(const Config& config) {
    std::map<std::string, Job> jobs;
    for (const PlannedJob& planned : list_jobs(config).jobs)
      jobs.emplace(planned.name, planned.job);
    return jobs;
  }

  Json settings_in(const Config& config, const Job& job) {
    return settings_by_content(job_settings(config, job, input_hashes(config, job, hashes_)));
  }

  std::string config_in(const fs::path& folder, const JobOnDisk& job) {
    const Read& from = read(folder, job.record.set);
    const auto found = from.jobs.find(job.name);
    if (found == from.jobs.end())
      throw Error("{} has no such job any more", from.config->file.string());
    const Config& config = *from.config;
    const Job planned = found->second;
    const Json made_by = settings_by_content(job.record.settings);
    const Json now = settings_in(config, planned);
    for (const auto& [key, value] : made_by.items())
      if (!now.contains(key) || now[key] != value)
        throw Error("its {} or a file of it has changed since it was made", key);
    const std::string text = job_config(config, planned);
    const Config alone = parse_config(text, "picked.toml");
    if (settings_in(alone, jobs_of(alone).at(job.name)) != now)
      throw Error("a config of its own would make another picture");
    return text;
  }

  const RunOnDisk& run_;
  std::vector<fs::path> folders_;
  std::map<fs::path, std::vector<Read>> read_;
  FileHashes hashes_;
};

// Of the program that made it.
std::string version_of(const JobRecord& record) {
  for (const auto& [name, version] : record.versions)
    if (name == "gramloom") return version;
  return "of an unknown version";
}

// What the config's reader is told first. Neural results depend on the threads.
std::string head_of(const fs::path& config, const JobOnDisk& job) {
  const JobRecord& record = job.record;
  const bool threads = record.kind == NeuralParams::kind && record.machine.threads > 0;
  return fmt::format("# {}, made by gramloom {}. Again: gramloom run {}{}\n", valid_utf8(job.name),
                     version_of(record), valid_utf8(config.filename().string()),
                     threads ? fmt::format(" --threads {}", record.machine.threads) : "");
}

std::vector<std::string> files_of(const JobOnDisk& job) {
  std::vector<std::string> files;
  for (const std::string& name : job.record.files) {
    if (fs::path(name).filename() != name) throw Error("{}: {} is elsewhere", job.name, name);
    files.push_back((fs::path(job.name).parent_path() / name).generic_string());
  }
  return files;
}

std::vector<Pick> picks_of(const PickWork& work) {
  const RunOnDisk run = read_named_run(work.run);
  try {
    Origin origin(run);
    std::vector<Pick> picks;
    for (const std::string& name : names_of(work)) {
      const JobOnDisk& job = find_job(run, name);
      picks.push_back({name, files_of(job), head_of(name + ".toml", job) + origin.config_of(job)});
    }
    return picks;
  } catch (const Error& error) {
    throw ConfigError("pick {}: {}", work.run.string(), error.what());
  }
}

// Files of the folder and their hashes.
using Hashes = std::map<std::string, std::string>;

// The files that an earlier pick has left there, by its own list.
Hashes earlier_files(const fs::path& output) {
  Hashes files;
  try {
    const Json list = read_json(output / picked_mark);
    for (const auto& [file, hash] : list.at("files").items()) {
      const fs::path path = fs::path(file).lexically_normal();
      if (path.is_relative() && !path.empty() && *path.begin() != "..")
        files.emplace(path.generic_string(), hash.get<std::string>());
    }
  } catch (const std::exception&) {  // there is none, or it was changed: all stays
  }
  return files;
}

// What is to be in the folder. Its files' texts are not kept: pictures may be many.
Hashes hashes_of(const PickWork& work, const std::vector<Pick>& picks) {
  Hashes hashes;
  for (const Pick& pick : picks) {
    for (const std::string& file : pick.files)
      hashes.emplace(fs::path(file).generic_string(), file_hash(work.run / file));
    hashes.emplace(pick.job + ".toml", hash_of(pick.config));
  }
  return hashes;
}

// A file that is there is as the earlier pick left it, or already as this one will; else it is the
// user's.
void refuse_what_is_not_ours(const PickWork& work, const Hashes& before, const Hashes& after) {
  for (const auto& [file, hash] : after) {
    if (!fs::exists(work.output / file)) continue;
    const std::string found = file_hash(work.output / file);
    const auto left = before.find(file);
    if (found != hash && (left == before.end() || found != left->second))
      throw ConfigError(
          "pick {}: --output {}: {} was not made by an earlier pick, or changed since; "
          "choose another folder",
          work.run.string(), work.output.string(), file);
  }
}

void write_mark(const PickWork& work, const Hashes& files) {
  const Json list{
      {"gramloom", version()}, {"run", fs::absolute(work.run).generic_string()}, {"files", files}};
  write_text(work.output / picked_mark, to_text(list, 2) + "\n");
}

}  // namespace

std::vector<fs::path> pick_results(const PickWork& work) {
  const std::vector<Pick> picks = picks_of(work);
  check_marked_folder({"pick", work.run, work.output, picked_mark});
  const Hashes before = earlier_files(work.output), after = hashes_of(work, picks);
  refuse_what_is_not_ours(work, before, after);
  create_folder(work.output);
  Hashes both = after;
  both.insert(before.begin(), before.end());
  write_mark(work, both);  // so that nothing is forgotten when this is interrupted
  std::vector<fs::path> textures;
  for (const Pick& pick : picks) {
    create_folder((work.output / pick.job).parent_path());
    for (const std::string& file : pick.files)
      write_text(work.output / file, read_text(work.run / file));
    write_text(work.output / (pick.job + ".toml"), pick.config);
    textures.push_back(work.output / pick.files.front());
  }
  for (const auto& [file, hash] : before)
    if (!after.contains(file) && fs::exists(work.output / file) &&
        file_hash(work.output / file) == hash)
      remove_file(work.output / file);
  write_mark(work, after);
  return textures;
}

}  // namespace gramloom
