// The only place that catches everything and prints.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "commands/command.h"
#include "core/error.h"
#include "io/text_file.h"
#include "jobs/progress_bar.h"

namespace {

using namespace gramloom;

// A parent may have closed our standard streams; a result's file must not get their numbers.
void keep_standard_streams_open() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDWR) == -1) std::_Exit(bad_usage);
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams_open();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond a limit is an error of its job
  try {
    return run_program(argc, argv);
  } catch (const ConfigError& error) {
    print_message(error.what());
    return bad_usage;
  } catch (
      const std::filesystem::filesystem_error& error) {  // a name that cannot even be looked at
    print_message(fmt::format("{}: {}", error.path1().string(), error.code().message()));
    return bad_usage;
  } catch (const std::bad_alloc&) {
    print_message("gramloom: out of memory");
  } catch (const std::exception& error) {
    print_message(fmt::format("gramloom: {}", first_line(error.what())));
  }
  return job_failed;
}
