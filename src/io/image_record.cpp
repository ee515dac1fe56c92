#include "io/image_record.h"

#include <nlohmann/json.hpp>

namespace gramloom {

using Json = nlohmann::json;

std::string to_description(const ImageRecord& record) {
  const Json json{{"gramloom",
                   {{"channels", record.channel_names},
                    {"colour_space", record.colour_space},
                    {"metadata", record.metadata}}}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::optional<ImageRecord> from_description(const std::string& description) {
  try {
    const Json json = Json::parse(description).at("gramloom");
    return ImageRecord{json.at("channels").get<std::vector<std::string>>(),
                       json.at("colour_space").get<std::string>(),
                       json.at("metadata").get<Metadata>()};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace gramloom
