#pragma once

#include <filesystem>
#include <new>
#include <string>

#include "core/error.h"
#include "io/json_text.h"

namespace gramloom {

/// What `work` returns. What it throws becomes an Error that begins with the path: work that knows
/// the path itself names it, what lies below does not.
template <class Work>
auto with_path(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw Error("{}: out of memory", path.string());
  } catch (const std::exception& error) {
    const std::string message = message_of(error);
    if (message.starts_with(path.string() + ":")) throw Error("{}", message);
    throw Error("{}: {}", path.string(), message);
  }
}

}  // namespace gramloom
