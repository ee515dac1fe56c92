#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace gramloom {

/// The whole file, byte for byte. A pipe may be read too, of at most 64 MB; one that nobody writes
/// to is empty. Throws Error with the path: missing, a folder, a device, unreadable.
std::string read_text(const std::filesystem::path& path);

/// The same, a piece of at most a megabyte after the other: `use` may have had some when it throws.
void read_blocks(const std::filesystem::path& path,
                 const std::function<void(std::string_view)>& use);

/// The first line of a message: libraries like to add a stack trace.
std::string first_line(const std::string& text);

/// Writes `text` (any bytes) to `path`, complete or not at all: a temporary file in the same folder
/// (".NAME.PID.COUNT.tmp", gone afterwards whatever happens short of SIGKILL) is written, flushed
/// to the disk and renamed, so a reader sees the old file or the new one. A device or pipe
/// (/dev/stdout) is written directly. Every file of gramloom is written
/// through here but pictures, which grow row by row (image_rows.h).
/// Throws Error with the path: no such folder, not writable, disk full, a folder of that name.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace gramloom
