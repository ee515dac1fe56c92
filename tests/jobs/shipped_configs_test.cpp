// Every config that we ship is valid: configs/*.toml and those that make data/.
#include <gtest/gtest.h>

#include <filesystem>

#include "jobs/config.h"
#include "jobs/plan.h"
#include "jobs/simulation.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

TEST(ShippedConfigs, AreValidAndEveryJobCanRun) {
  for (const char* folder : {"configs", "data"}) {
    const fs::path path = source_folder() / folder;
    if (!fs::is_directory(path)) continue;
    for (const auto& entry : fs::directory_iterator(path)) {
      if (entry.path().extension() != ".toml") continue;
      SCOPED_TRACE(entry.path().string());
      if (entry.path().filename() == "sleeve.toml") {
        EXPECT_NO_THROW(read_simulation(entry.path()));
        continue;
      }
      Plan plan;
      ASSERT_NO_THROW(plan = make_plan(read_config(entry.path())));
      for (const auto& job : plan.jobs) EXPECT_EQ(job.error, "") << job.name;
    }
  }
}

}  // namespace
}  // namespace gramloom
