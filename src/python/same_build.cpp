#include "python/same_build.h"

#include <cstdio>
#include <memory>

#include "core/build_stamp.h"
#include "core/build_stamp_value.h"
#include "core/error.h"
#include "core/modules.h"
#include "jobs/machine.h"

namespace gramloom::python {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view what_to_do =
    "install all of one version, or in a checkout run ./bootstrap build";

// As one word of a shell.
std::string one_word(const std::string& text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

// What the program says of itself; "" when it says nothing.
std::string version_line_of(const fs::path& program) {
  const std::string command = one_word(program.string()) + " --version 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "re"), pclose);
  std::string line;
  for (int letter; pipe && (letter = std::fgetc(pipe.get())) != EOF && letter != '\n';)
    line += static_cast<char>(letter);
  return line;
}

fs::path found_program() {
  const fs::path libraries = libraries_folder();
  const fs::path built = libraries / "gramloom";
  const fs::path installed = libraries.parent_path().parent_path() / "bin/gramloom";
  for (const fs::path& file : {built, installed})
    if (fs::is_regular_file(file)) return file;
  throw ConfigError("jobs: there is no program to do them, neither {} nor {}", built.string(),
                    installed.string());
}

}  // namespace

std::string library_refusal() {
  if (build_stamp() == GRAMLOOM_BUILD_STAMP) return "";
  return fmt::format("gramloom: {} is of another build than Python's module: {}",
                     (libraries_folder() / "libgramloom_core.so").string(), what_to_do);
}

fs::path program_file() {
  const fs::path file = found_program();
  const std::string said = version_line_of(file);
  if (said != version_line())
    throw ConfigError("jobs: {} is {}, Python's module is of {}: {}", file.string(),
                      said.empty() ? "no gramloom" : said, version_line(), what_to_do);
  return file;
}

}  // namespace gramloom::python
