#include "jobs/worker_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/polling.h"
#include "jobs/settings.h"

namespace gramloom {

namespace {

constexpr std::chrono::seconds patience{3};

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error("cannot start a process: {}", std::strerror(errno));
  return ends;
}

// In the child, between fork and exec: only what may be called there.
[[noreturn]] void become(const char* program, char* const* words, int tasks, int answers) {
  setpgid(0, 0);  // Ctrl-C is for the parent, which tells its workers
  // An end that has the other's number already must not be closed by that one.
  if (tasks == worker_answers) tasks = dup(tasks);
  if (answers == worker_answers)
    fcntl(answers, F_SETFD, 0);
  else
    dup2(answers, worker_answers);
  dup2(tasks, STDIN_FILENO);
  execv(program, words);
  _exit(127);
}

void close_end(int& end) {
  if (end >= 0) close(std::exchange(end, -1));
}

}  // namespace

WorkerProcess::WorkerProcess(const std::filesystem::path& program,
                             const std::vector<std::string>& words, int threads,
                             const std::string& greeting) {
  std::vector<std::string> own = words;
  own.insert(own.begin() + 2, fmt::format("--worker={}", threads));
  std::vector<char*> pointers;
  for (std::string& word : own) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  auto tasks = make_pipe(), answers = make_pipe();
  process_ = fork();
  if (process_ == 0)
    become(program.empty() ? "/proc/self/exe" : program.c_str(), pointers.data(), tasks[0],
           answers[1]);
  close(tasks[0]);
  close(answers[1]);
  tasks_ = tasks[1];
  answers_ = answers[0];
  fcntl(answers_, F_SETFL, O_NONBLOCK);
  if (process_ < 0) {
    close_end(tasks_);
    close_end(answers_);
    throw Error("cannot start a process: {}", std::strerror(errno));
  }
  const std::string line = greeting + "\n";
  if (write(tasks_, line.data(), line.size()) == std::ssize(line)) return;
  how_it_ended();
  close_end(answers_);
  throw Error("cannot speak to a process that was started");
}

WorkerProcess::~WorkerProcess() {
  how_it_ended();
  close_end(answers_);
}

bool WorkerProcess::ask(const Task& task) {
  const std::string line = to_text(to_json_value(task), -1) + "\n";
  return write(tasks_, line.data(), line.size()) == std::ssize(line);
}

std::optional<std::vector<WorkerAnswer>> WorkerProcess::answers() {
  std::array<char, 65536> some{};
  ssize_t count = 0;
  while ((count = read(answers_, some.data(), some.size())) < 0 && errno == EINTR) {
  }
  // A failure to read is no end, as long as there is someone.
  if (count == 0 || (count < 0 && has_ended())) return std::nullopt;
  if (count < 0) return std::vector<WorkerAnswer>();
  rest_.append(some.data(), static_cast<std::size_t>(count));
  std::vector<WorkerAnswer> found;
  std::size_t begin = 0;
  for (std::size_t end; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1)
    found.push_back(from_json_value<WorkerAnswer>(parse_json(rest_.substr(begin, end - begin)),
                                                  {"an answer", "", false}));
  rest_.erase(0, begin);
  return found;
}

void WorkerProcess::stop() {
  if (!has_ended()) kill(process_, SIGTERM);
}

bool WorkerProcess::has_ended() {
  if (process_ > 0 && waitpid(process_, &status_, WNOHANG) != 0) process_ = -1;
  return process_ < 0;
}

std::string WorkerProcess::how_it_ended() {
  close_end(tasks_);  // it ends when there is no more to read
  for (const int signal : {0, SIGTERM, SIGKILL}) {
    if (signal != 0 && !has_ended()) kill(process_, signal);
    if (comes_true(patience, [&] { return has_ended(); })) break;
  }
  if (WIFSIGNALED(status_)) return fmt::format("was killed by signal {}", WTERMSIG(status_));
  return fmt::format("ended with code {}", WEXITSTATUS(status_));
}

}  // namespace gramloom
