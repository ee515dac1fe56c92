#include "runs/run_record.h"

namespace gramloom {

void RunRecord::upgrade(Json& json, const std::string& file) { required_key(json, "jobs", {file}); }

JobStanding standing_of(const JobRecord& record) {
  return {record.status, record.seconds, record.error};
}

}  // namespace gramloom
