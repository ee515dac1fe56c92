#pragma once

#include <nlohmann/json.hpp>

namespace gramloom {

/// JSON whose keys stay in the order in which they were set.
using Json = nlohmann::ordered_json;

}  // namespace gramloom
