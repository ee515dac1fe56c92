#include "jobs/run_file.h"

#include "io/text_file.h"
#include "jobs/machine.h"

namespace gramloom {

namespace {

Json job_state(const std::optional<JobRecord>& record) {
  if (!record) return {{"status", "waiting"}};
  Json state{{"status", to_word(record->status)}, {"seconds", record->seconds}};
  if (!record->error.empty()) state["error"] = record->error;
  return state;
}

}  // namespace

RunFile::RunFile(const Config& config, const Plan& plan, const std::filesystem::path& output)
    : file_(output / "run.json") {
  content_ = {{"versions", versions_to_json()}, {"machine", machine_to_json()},
              {"config", config.file.string()}, {"config_text", config.text},
              {"set", config.overrides},        {"settings", config_to_json(config)},
              {"jobs", Json::object()}};
  for (const auto& job : plan.jobs)
    content_["jobs"][job.name] = job_state(read_record(output / (job.name + ".json")));
  write();
}

void RunFile::set(const std::string& job, const JobRecord& record) {
  content_["jobs"][job] = job_state(record);
  write();
}

void RunFile::write() const {
  write_text(file_, content_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace gramloom
