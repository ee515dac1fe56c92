#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "cli/process.h"
#include "core/random.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "runs/record.h"

namespace gramloom {

/// Exactly one line.
inline bool is_one_line(const std::string& text) {
  return !text.empty() && text.find('\n') == text.size() - 1;
}

/// A test with an empty folder to run the executable in: "e.png" is an exemplar, "c.toml" a config
/// of four short jobs.
class Workspace : public testing::Test {
 protected:
  Workspace()
      : folder_(std::filesystem::temp_directory_path() / fmt::format("gramloom_cli_{}", getpid())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    Image image(32, 32, 3);
    Random random(1);
    for (float& value : image.pixels) value = random.uniform();
    write_image(folder_ / "e.png", image, {});
    write_text(folder_ / "c.toml",
               "seeds = [1, 2]\n"
               "size = [40, 24]\n"
               "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n"
               "[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'noise'\n");
  }
  ~Workspace() override { std::filesystem::remove_all(folder_); }

  Outcome run(std::vector<std::string> arguments) const { return gramloom(folder_, arguments); }

  // The command ends with this exit code and one line that holds the message.
  void expect_refused(const std::string& command, const std::vector<std::string>& arguments,
                      const std::string& message, int exit_code = 2) const {
    std::vector<std::string> words{command};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, exit_code) << message << outcome.errors;
    EXPECT_THAT(outcome.errors, testing::HasSubstr(message));
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  }

  std::optional<JobRecord> record(const std::string& job, const std::string& out = "out/c") const {
    return find_record(folder_ / out / (job + ".json"));
  }
  std::string file(const std::string& name) const { return read_text(folder_ / name); }

  const std::filesystem::path folder_;
};

}  // namespace gramloom
