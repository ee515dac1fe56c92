#include "core/spinning.h"

#include <dlfcn.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace gramloom {

namespace {

// Turns of a wait, some ten microseconds. More were not quicker, 100 a little slower.
constexpr const char* turns = "1000";

bool is_loaded(const char* library) {
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  if (handle) dlclose(handle);
  return handle != nullptr;
}

// Returns only if that is not possible.
void begin_anew(const std::vector<std::string>& arguments) {
  if (getauxval(AT_BASE) == 0) return;  // /proc/self/exe is the dynamic loader, started by hand
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) return;
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
}

}  // namespace

void bound_spinning(const std::vector<std::string>& arguments) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  setenv("GOMP_SPINCOUNT", turns, 0);
  if (is_loaded("libgomp.so.1")) begin_anew(arguments);
}

}  // namespace gramloom
