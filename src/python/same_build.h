#pragma once

#include <filesystem>
#include <string>

namespace gramloom::python {

/// Why this extension cannot work with the libraries that it has found: they are of another build.
/// "": it can.
std::string library_refusal();

/// The program of the same build, or of the same installation, as this extension. Throws
/// ConfigError when there is none, or one of another build or version.
std::filesystem::path program_file();

}  // namespace gramloom::python
