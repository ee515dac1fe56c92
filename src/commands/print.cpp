#include <cerrno>
#include <cstdio>
#include <cstring>

#include "commands/command.h"
#include "core/error.h"

namespace gramloom {

ExitCode print(const std::string& text) {
  const bool complete =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (complete || errno == EPIPE) return all_done;
  throw Error("cannot write to standard output: {}", std::strerror(errno));
}

}  // namespace gramloom
