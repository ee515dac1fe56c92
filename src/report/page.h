#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runs/run_folder.h"

namespace gramloom {

/// The page that shows `data` (see page_data): one text with style and script inside. Whatever the
/// data's texts hold, it stays data.
std::string page_html(const nlohmann::ordered_json& data);

struct WrittenPage {
  std::filesystem::path file;
  std::vector<std::string> trouble;  // what it could not show and why, a line each
};

/// Writes folder/index.html, and previews in folder/page, from what a run has left in the folder.
/// Throws Error.
WrittenPage write_page(const std::filesystem::path& folder);
/// The same of a run that has been read.
WrittenPage write_page(const RunOnDisk& run);

}  // namespace gramloom
