#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"

// Each fuzz target gives any bytes to a reader of ours, which must read them or throw Error with
// one line: everything else is a finding, which libFuzzer keeps as a file.

namespace gramloom {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file of these bytes in memory, for readers that want one.
inline std::filesystem::path file_of(const std::string& bytes, const std::string& extension) {
  static const std::filesystem::path folder = [] {
    const std::filesystem::path made = fmt::format("/dev/shm/gramloom_fuzz_{}", getpid());
    std::filesystem::create_directories(made);
    std::atexit([] {
      std::error_code ignored;
      std::filesystem::remove_all(fmt::format("/dev/shm/gramloom_fuzz_{}", getpid()), ignored);
    });
    return made;
  }();
  const std::filesystem::path file = folder / ("input" + extension);
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

template <class F>
void read_or_refuse(F&& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string line = error.what();
    if (!line.empty() && line.find('\n') == std::string::npos) return;
    std::fprintf(stderr, "no single line: '%s'\n", line.c_str());
    std::abort();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "not an Error: %s\n", error.what());
    std::abort();
  }
}

}  // namespace gramloom
