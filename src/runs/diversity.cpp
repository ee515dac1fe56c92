#include "runs/diversity.h"

#include <map>
#include <set>

#include "core/hash.h"
#include "runs/format.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

// Adds a job to what its exemplar and method have.
void add(SeedDiversity& of, const JobRecord& record) {
  of.seeds.push_back(record.seed);
  const bool known = !record.texture.empty() && (of.seeds.size() == 1 || !of.textures.empty());
  of.textures = known ? hash_of(of.textures + record.texture) : "";
}

}  // namespace

SeedDiversity diversity_of_records(const std::string& exemplar, const std::string& method,
                                   const std::vector<NamedRecord>& jobs) {
  SeedDiversity of{exemplar, method, {}, 0, ""};
  for (const auto& [name, record] : jobs)
    if (record.status == Status::done && record.exemplar == exemplar && record.method == method)
      add(of, record);
  return of;
}

std::vector<SeedDiversity> find_diversity(const std::filesystem::path& output,
                                          const std::vector<NamedRecord>& jobs,
                                          const std::vector<SeedDiversity>& earlier) {
  using Name = std::pair<std::string, std::string>;  // of an exemplar and a method
  std::map<Name, const SeedDiversity*> before;
  for (const SeedDiversity& of : earlier) before[{of.exemplar, of.method}] = &of;
  std::set<Name> looked_for;
  std::vector<SeedDiversity> found;
  for (const auto& [name, record] : jobs) {
    const Name of{record.exemplar, record.method};
    if (!looked_for.insert(of).second) continue;
    try {
      const auto file = diversity_file(output, of.first, of.second);
      std::error_code ignored;
      if (std::filesystem::exists(file, ignored))
        found.push_back(read_format<SeedDiversity>(file));
      else if (before.contains(of))
        found.push_back(*before.at(of));
    } catch (const Error&) {  // it is made anew
    }
  }
  return found;
}

std::vector<SeedDiversity> valid_diversity(const std::vector<SeedDiversity>& list,
                                           const std::vector<NamedRecord>& jobs) {
  std::map<std::pair<std::string, std::string>, SeedDiversity> now;
  for (const auto& [name, record] : jobs)
    if (record.status == Status::done) add(now[{record.exemplar, record.method}], record);
  std::vector<SeedDiversity> valid;
  for (const SeedDiversity& of : list) {
    const auto found = now.find({of.exemplar, of.method});
    if (found != now.end() && found->second.seeds == of.seeds &&
        found->second.textures == of.textures)
      valid.push_back(of);
  }
  return valid;
}

}  // namespace gramloom
