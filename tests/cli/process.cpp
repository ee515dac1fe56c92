#include "cli/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace gramloom {

namespace {

namespace fs = std::filesystem;

std::string take_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  file.close();
  fs::remove(path);
  return text;
}

fs::path fresh_file(const char* kind) {
  static std::atomic<int> count{0};
  return fs::temp_directory_path() /
         ("gramloom_cli_" + std::to_string(getpid()) + "_" + std::to_string(count++) + "." + kind);
}

void redirect(int stream, const fs::path& file) {
  const int to = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(to, stream);
  close(to);
}

// Between fork and exec; never returns.
[[noreturn]] void become(const fs::path& folder, const std::vector<std::string>& command) {
  if (chdir(folder.c_str()) != 0) _exit(126);
  std::vector<char*> words;
  for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(words[0], words.data());
  _exit(127);
}

Outcome wait_for(pid_t pid, const fs::path& output, const fs::path& errors) {
  int status = 0;
  rusage used{};
  wait4(pid, &status, 0, &used);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), take_file(output),
          take_file(errors), 1024.0 * static_cast<double>(used.ru_maxrss)};
}

}  // namespace

Process::Process(const fs::path& folder, const std::vector<std::string>& arguments)
    : output_(fresh_file("out")), errors_(fresh_file("err")) {
  std::vector<std::string> command{GRAMLOOM_EXECUTABLE};
  command.insert(command.end(), arguments.begin(), arguments.end());
  pid_ = fork();
  if (pid_ == 0) {
    redirect(STDOUT_FILENO, output_);
    redirect(STDERR_FILENO, errors_);
    become(folder, command);
  }
}

Process::~Process() {
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  wait();
}

void Process::signal(int number) const { kill(pid_, number); }

Outcome Process::wait() {
  const Outcome outcome = wait_for(pid_, output_, errors_);
  pid_ = -1;
  return outcome;
}

Outcome gramloom(const fs::path& folder, const std::vector<std::string>& arguments) {
  return Process(folder, arguments).wait();
}

Outcome shell(const fs::path& folder, const std::string& command) {
  const fs::path output = fresh_file("out");
  const fs::path errors = fresh_file("err");
  const pid_t pid = fork();
  if (pid == 0) {
    setenv("GRAMLOOM", GRAMLOOM_EXECUTABLE, 1);
    redirect(STDOUT_FILENO, output);
    redirect(STDERR_FILENO, errors);
    become(folder, {"/bin/sh", "-c", command});
  }
  return wait_for(pid, output, errors);
}

}  // namespace gramloom
