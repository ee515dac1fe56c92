#include "commands/written_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "jobs/config.h"
#include "jobs/key_lists.h"
#include "jobs/plan.h"
#include "runs/format.h"
#include "runs/run_record.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// What `read` gives, or nothing: a line that is being typed may name anything.
template <class Read>
std::vector<Candidate> or_none(const Read& read) {
  try {
    return read();
  } catch (const Error&) {
    return {};
  }
}

// Of a method that holds a procedural texture those of the texture too.
std::vector<Key> keys_of(const Method& method) {
  std::vector<Key> keys;
  const auto add = [&](const std::vector<KeyList>& lists, std::string_view name) {
    const auto list = std::ranges::find(lists, name, &KeyList::name);
    if (list != lists.end()) keys.insert(keys.end(), list->keys.begin(), list->keys.end());
  };
  add(method_lists(), kind_of(method));
  if (const auto* procedural = std::get_if<ProceduralParams>(&method))
    add(texture_lists(),
        std::visit([](const auto& texture) { return texture.name; }, procedural->texture));
  return keys;
}

}  // namespace

std::vector<Candidate> settings_of_methods(const fs::path& config) {
  return or_none([&] {
    std::vector<Candidate> candidates;
    for (const MethodEntry& entry : read_config(config).methods)
      for (const Key& key : keys_of(entry.method))
        candidates.push_back({fmt::format("method.{}.{}=", entry.name, key.name), meaning_of(key)});
    return candidates;
  });
}

std::vector<Candidate> jobs_of_config(const fs::path& config) {
  return or_none([&] {
    std::vector<Candidate> candidates;
    for (const PlannedJob& job : list_jobs(read_config(config)).jobs)
      candidates.push_back({job.name, ""});
    return candidates;
  });
}

std::vector<Candidate> jobs_of_run(const fs::path& folder) {
  return or_none([&] {
    std::vector<Candidate> candidates;
    for (const auto& [name, standing] : read_format<RunRecord>(folder / "run.json").jobs)
      if (standing.status == Status::done) candidates.push_back({name, ""});
    return candidates;
  });
}

}  // namespace gramloom
