#include <algorithm>

#include "io/field_values.h"
#include "jobs/baseline_compare.h"
#include "jobs/text_table.h"

namespace gramloom {

std::size_t count_worse(const std::vector<Change>& changes) {
  return static_cast<std::size_t>(
      std::count_if(changes.begin(), changes.end(),
                    [](const Change& change) { return change.verdict == Verdict::worse; }));
}

std::string change_table(const std::vector<Change>& changes, const Baseline& before,
                         const Baseline& now) {
  std::vector<Row> rows{{"", "job", "what", "before", "now"}};
  for (std::size_t verdict = 0; verdict < enum_names<Verdict>.size(); ++verdict)
    for (const Change& change : changes)
      if (change.verdict == static_cast<Verdict>(verdict))
        rows.push_back({std::string(to_word(change.verdict)), change.job, change.what,
                        change.before, change.now});
  return (changes.empty() ? "" : text_table(rows, "")) +
         fmt::format("{} jobs against {}: {} worse, {} changes in all\n", now.jobs.size(),
                     before.folder.string(), count_worse(changes), changes.size());
}

std::string change_json(const std::vector<Change>& changes, const Baseline& before,
                        const BaselineLimits& limits) {
  nlohmann::ordered_json json{{"baseline", before.folder.generic_string()}};
  for_each_field<BaselineLimits>(
      [&](const auto& field) { json["limits"][std::string(field.name)] = limits.*field.member; });
  json["worse"] = count_worse(changes);
  json["changes"] = Json::array();
  for (const Change& change : changes)
    json["changes"].push_back({{"verdict", to_word(change.verdict)},
                               {"job", change.job},
                               {"what", change.what},
                               {"before", change.before},
                               {"now", change.now}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gramloom
