#include "io/image_record.h"

#include "io/json_text.h"

namespace gramloom {

std::string to_description(const ImageRecord& record) {
  Json json{{"gramloom",
             {{"channels", record.channel_names},
              {"colour_space", record.colour_space},
              {"metadata", record.metadata}}}};
  if (record.premultiplied) json["gramloom"]["premultiplied"] = true;
  return to_text(json, -1, true);
}

std::optional<ImageRecord> from_description(const std::string& description) {
  try {
    const Json json = parse_json(description).at("gramloom");
    return ImageRecord{json.at("channels").get<std::vector<std::string>>(),
                       json.at("colour_space").get<std::string>(),
                       json.at("metadata").get<Metadata>(), json.value("premultiplied", false)};
  } catch (const Error&) {
    return std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace gramloom
