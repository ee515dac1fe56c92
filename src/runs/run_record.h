#pragma once

#include <string>
#include <vector>

#include "io/json_fields.h"
#include "runs/circumstances.h"
#include "runs/diversity.h"
#include "runs/record.h"

namespace gramloom {

/// How a job stands, in short: its record has the rest.
struct JobStanding {
  Status status = Status::waiting;
  double seconds = 0;
  std::string error;

  static constexpr auto fields() {
    using S = JobStanding;
    return std::tuple{
        Field{"status", &S::status, "how the job stands"},
        Field{"seconds", &S::seconds, "time that the method took", "s", {0, 1e300}},
        Field{"error", &S::error, "why it is not done"},
    };
  }
};

/// The content of run.json: what was asked for, where it ran last, and an overview of the jobs.
/// The overview and the diversities are derived from the jobs' records; where they differ, because
/// the run was killed, the records hold.
struct RunRecord {
  static constexpr int version = 2;
  static constexpr std::string_view what = "the run.json of a run";

  std::string date;  // when the run began: "2026-11-22T08:15:00Z"
  std::vector<std::string> command;
  Named<std::string> versions;
  Machine machine;
  std::string config;       // its path as the command line had it
  std::string config_text;  // as it stood on disk
  std::vector<std::string> set;
  Json settings;  // the whole config with every default
  Named<JobStanding> jobs;
  std::vector<SeedDiversity> diversity;

  static constexpr auto fields() {
    using R = RunRecord;
    return std::tuple{
        Field{"date", &R::date, "when the run began"},
        Field{"command", &R::command, "the command line"},
        Field{"versions", &R::versions, "of the program and its libraries"},
        Field{"machine", &R::machine, "where it ran"},
        Field{"config", &R::config, "path of the config"},
        Field{"config_text", &R::config_text, "the config as it stood on disk"},
        Field{"set", &R::set, "the values of --set"},
        Field{"settings", &R::settings, "the whole config with every default"},
        Field{"jobs", &R::jobs, "how each job stands"},
        Field{"diversity", &R::diversity, "how unlike the results of several seeds are"},
    };
  }

  /// Version 1 is refused without jobs; its numbers of a job could be missing. Throws Error.
  static void upgrade(Json& json, const std::string& file);
};

JobStanding standing_of(const JobRecord& record);

}  // namespace gramloom
