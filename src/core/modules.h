#pragma once

#include <filesystem>
#include <string_view>

namespace gramloom {

// Parts of the program that bring large libraries along (LibTorch, OpenImageIO) are shared
// libraries of their own, opened when they are first needed: all else starts without them.

/// Where the shared libraries of the program lie: in the build folder, or in lib/gramloom.
std::filesystem::path libraries_folder();

namespace detail {
const void* open_module(std::string_view name);
}

/// The functions of a module. `Functions` is a struct of pointers to functions with the module's
/// `name`; libgramloom_NAME.so, beside the library of this function, defines one as
/// `extern "C" const Functions gramloom_NAME_module`. Exceptions pass through. Throws Error when
/// the module, or a library that it needs, cannot be opened, or is of another build.
template <class Functions>
const Functions& open_module() {
  static const auto& functions =
      *static_cast<const Functions*>(detail::open_module(Functions::name));
  return functions;
}

}  // namespace gramloom
