#include <algorithm>

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

}  // namespace gramloom
