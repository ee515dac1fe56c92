#pragma once

#include <string_view>

#include "jobs/settings.h"

namespace gramloom {

/// "0.1.0"
std::string_view version();

/// The versions of the program and of the libraries that it was built with.
Json versions_to_json();

/// Processor, cores, threads in use, memory.
Json machine_to_json();

}  // namespace gramloom
