#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/image_file.h"
#include "io/text_file.h"
#include "jobs/runner.h"
#include "runs/record.h"

namespace gramloom {

/// A config of two short jobs.
inline const std::string two_textures =
    "size = [24, 16]\n"
    "[[method]]\nname = 'a'\nkind = 'procedural'\ntexture = 'noise'\n"
    "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
    "[[method]]\nname = 'b'\nkind = 'quilting'\npatch_size = 8\n";

/// A test with a folder to run configs in: "e.png" is an exemplar, results go to "out".
class Runner : public testing::Test {
 protected:
  Runner()
      : folder_(std::filesystem::temp_directory_path() /
                fmt::format("gramloom_runner_{}", getpid())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    write_exemplar(1);
  }
  ~Runner() override { std::filesystem::remove_all(folder_); }

  void write_exemplar(std::uint64_t seed, Encoding encoding = {}) const {
    Image image(32, 32, 3);
    Random random(seed);
    for (float& value : image.pixels) value = random.uniform();
    write_image(folder_ / "e.png", image, encoding);
  }

  RunSummary run_text(const std::string& text, RunOptions options = {},
                      const std::vector<std::string>& set = {}) const {
    options.output = folder_ / "out";
    ProgressBar bar(ProgressStyle::quiet);
    return run(parse_config(text, folder_ / "c.toml", set), options, bar);
  }
  RunSummary resume(const std::string& text, const std::vector<std::string>& set = {}) const {
    RunOptions options;
    options.resume = true;
    return run_text(text, options, set);
  }

  std::filesystem::path out(const std::string& name) const { return folder_ / "out" / name; }
  JobRecord record(const std::string& job) const {
    const auto found = find_record(out(job + ".json"));
    EXPECT_TRUE(found) << job;
    return found.value_or(JobRecord{});
  }

  std::filesystem::path folder_;
};

}  // namespace gramloom
