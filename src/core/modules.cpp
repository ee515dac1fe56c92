#include "core/modules.h"

#include <dlfcn.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/build_stamp.h"
#include "core/error.h"

namespace gramloom {

// That of the library that this function is in.
std::filesystem::path libraries_folder() {
  Dl_info own{};
  dladdr(reinterpret_cast<const void*>(&libraries_folder), &own);
  // Without "..", which the linker leaves in: what lies above it is asked for.
  return std::filesystem::weakly_canonical(std::filesystem::absolute(own.dli_fname).parent_path());
}

namespace {

// What lies beside a module (module_list.cmake): it is read before any code of the module runs.
struct ModuleList {
  std::string stamp;
  std::vector<std::string> libraries;
};

ModuleList read_list(const std::filesystem::path& path) {
  ModuleList list;
  std::ifstream file(path);
  std::getline(file, list.stamp);
  for (std::string name; std::getline(file, name);) list.libraries.push_back(name);
  return list;
}

// One by one. The dynamic linker looks a name up in all that are opened at once: by themselves,
// most libraries need few others, but 250 come with a module, which would take twice as long. One
// that does not open by itself comes with the module, or the linker says there what is wrong.
void open_libraries(const std::vector<std::string>& names) {
  for (const std::string& name : names) dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
}

// Debian's package of a module (package/debian.cmake): LibTorch comes with one of its own.
std::string_view package_of(std::string_view module) {
  return module == "neural" || module == "train" ? "gramloom-neural" : "gramloom";
}

}  // namespace

const void* detail::open_module(std::string_view name) {
  const auto file = libraries_folder() / fmt::format("libgramloom_{}.so", name);
  if (!std::filesystem::exists(file))
    throw Error("{} is missing: install the package {}, or in a checkout run ./bootstrap build",
                file.string(), package_of(name));
  const ModuleList list = read_list(libraries_folder() / fmt::format("libgramloom_{}.txt", name));
  if (list.stamp != build_stamp())
    throw Error(
        "{} is of another build than the program: in a checkout run ./bootstrap build, or "
        "install the package {} anew",
        file.string(), package_of(name));
  open_libraries(list.libraries);
  // Never closed: LibTorch cannot be.
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* functions =
      module ? dlsym(module, fmt::format("gramloom_{}_module", name).c_str()) : nullptr;
  if (!functions) throw Error("a part of the program cannot be opened: {}", dlerror());
  return functions;
}

}  // namespace gramloom
