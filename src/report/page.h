#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "runs/run_folder.h"

namespace gramloom {

/// The page that shows `data` (see page_data): one text with style and script inside. Whatever the
/// data's texts hold, it stays data.
std::string page_html(const nlohmann::ordered_json& data);

/// Writes folder/index.html, and previews in folder/page, from what a run has left in the folder;
/// returns the page's path. Throws Error.
std::filesystem::path write_page(const std::filesystem::path& folder);
/// The same of a run that has been read.
std::filesystem::path write_page(const RunOnDisk& run);

}  // namespace gramloom
