#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace gramloom {

/// How the executable ended and what it said.
struct Outcome {
  int exit_code = -1;      // 128 + signal when a signal ended it
  std::string output;      // standard output
  std::string errors;      // standard error
  double peak_memory = 0;  // the most bytes that it held
};

/// The gramloom executable, running in `folder`.
class Process {
 public:
  Process(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  Outcome wait();

 private:
  std::filesystem::path output_;
  std::filesystem::path errors_;
  pid_t pid_ = -1;
};

Outcome gramloom(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// The same through a shell, which sees the executable as $GRAMLOOM.
Outcome shell(const std::filesystem::path& folder, const std::string& command);

}  // namespace gramloom
