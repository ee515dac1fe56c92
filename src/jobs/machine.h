#pragma once

#include <string>
#include <string_view>

#include "io/json_fields.h"
#include "runs/circumstances.h"

namespace gramloom {

/// "0.1.0"
std::string_view version();
/// "gramloom 0.1.0 (build 0123456789ab)", as `gramloom --version` says it.
std::string version_line();

/// The versions of the program and of the libraries that it was built with.
Named<std::string> versions();

/// The one that the program runs on, and the threads in use.
Machine machine();

}  // namespace gramloom
