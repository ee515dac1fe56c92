#include "jobs/score_files.h"

#include <algorithm>

#include "io/image_file.h"
#include "io/json_text.h"
#include "io/text_file.h"
#include "jobs/text_table.h"
#include "metrics/controls.h"
#include "metrics/exemplar_statistics.h"

namespace gramloom {

namespace {

// The value of this name, or nothing where the picture has none.
std::string value_text(const Scores& scores, std::string_view name) {
  for (const auto& [own, value] : scores.values)
    if (own == name) return fmt::format("{:.4g}", value);
  return "-";
}

std::vector<ScoredImage> score_controls(ExemplarStatistics& statistics, const Control& control) {
  const Image& exemplar = statistics.exemplar();
  std::vector<ScoredImage> scored;
  const auto& names = enum_names<ControlKind>;
  for (std::size_t i = 0; i < names.size(); ++i) {
    // Twice the size: at its own, the exemplar tiled is the exemplar.
    const Size size{2 * exemplar.width, 2 * exemplar.height};
    const auto pair = control_pair(static_cast<ControlKind>(i), exemplar, size, Random(1));
    const bool whole = pair.exemplar == exemplar;  // or a half
    scored.push_back({fmt::format("control:{}", names[i]),
                      whole ? score(statistics, pair.image, Tile::none, control)
                            : score(pair.exemplar, pair.image, Tile::none, control)});
  }
  return scored;
}

}  // namespace

std::vector<ScoredImage> score_files(const std::filesystem::path& exemplar,
                                     const std::vector<std::string>& images, Tile tile,
                                     bool controls, const Control& control) {
  ExemplarStatistics own(read_image(exemplar).image);
  std::vector<ScoredImage> scored;
  for (const auto& name : images) {
    try {
      const Image image = read_image(name).image;
      if (image.channels != own.exemplar().channels)
        throw Error("{}: has {} channels, the exemplar {} has {}", name, image.channels,
                    exemplar.string(), own.exemplar().channels);
      scored.push_back({name, score(own, image, tile, control)});
    } catch (const Interrupted&) {
      throw;
    } catch (const Error& error) {
      const std::string line = first_line(error.what());
      scored.push_back(
          {name, {}, line.starts_with(name) ? line : fmt::format("{}: {}", name, line)});
    }
  }
  if (controls)
    for (auto& one : score_controls(own, control)) scored.push_back(std::move(one));
  return scored;
}

std::string score_table(const std::vector<ScoredImage>& all) {
  std::vector<ScoredImage> scored;
  std::copy_if(all.begin(), all.end(), std::back_inserter(scored),
               [](const auto& one) { return one.error.empty(); });
  if (scored.empty()) return "";
  std::vector<Row> rows{{"score", "better"}};
  for (const auto& one : scored) rows[0].push_back(one.name);
  for (const Metric& metric : metrics()) {
    if (metric.group == "diversity") continue;  // of several seeds, not of one picture
    Row row{std::string(metric.name), metric.higher_is_better ? "more" : "less"};
    for (const auto& one : scored) row.push_back(value_text(one.scores, metric.name));
    rows.push_back(std::move(row));
  }
  return text_table(rows, "");
}

std::string score_json(const std::vector<ScoredImage>& scored) {
  Json json = Json::object();
  for (const auto& one : scored)
    for (const auto& [name, value] : one.scores.values) json[one.name][std::string(name)] = value;
  return to_text(json, 2) + "\n";
}

}  // namespace gramloom
