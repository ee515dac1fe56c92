#include "core/modules.h"

#include <dlfcn.h>

#include <filesystem>

#include "core/error.h"

namespace gramloom::detail {

namespace {

// Where the library lies that this function is in: in the build folder, or in lib/gramloom.
std::filesystem::path own_folder() {
  Dl_info own{};
  dladdr(reinterpret_cast<const void*>(&open_module), &own);
  return std::filesystem::absolute(own.dli_fname).parent_path();
}

}  // namespace

const void* open_module(std::string_view name) {
  const auto file = own_folder() / fmt::format("libgramloom_{}.so", name);
  // Never closed: LibTorch cannot be.
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* functions =
      module ? dlsym(module, fmt::format("gramloom_{}_module", name).c_str()) : nullptr;
  if (!functions) throw Error("a part of the program cannot be opened: {}", dlerror());
  return functions;
}

}  // namespace gramloom::detail
