#pragma once

#include <c10/util/Exception.h>

#include <new>
#include <string>

#include "core/error.h"
#include "io/text_file.h"

namespace gramloom::neural {

/// What `work` returns. LibTorch's errors, several lines that begin with a place in its source,
/// become Error in one line, or std::bad_alloc.
template <class Work>
auto with_plain_errors(Work&& work) {
  try {
    return work();
  } catch (const c10::Error& error) {
    const std::string text = error.what_without_backtrace();
    if (text.find("allocate memory") != std::string::npos) throw std::bad_alloc();
    throw Error("LibTorch: {}", first_line(text));
  }
}

}  // namespace gramloom::neural
