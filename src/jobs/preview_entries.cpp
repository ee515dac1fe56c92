#include "jobs/preview_entries.h"

#include "core/error.h"
#include "io/toml_reader.h"
#include "jobs/method_reader.h"
#include "jobs/names.h"
#include "jobs/overrides.h"
#include "jobs/plan.h"
#include "surface/preview.h"

namespace gramloom {

namespace {

constexpr std::string_view label = "preview";

// Where the table is; of one that --set makes, where its first key is.
const toml::source_region& region_of(const toml::table& table) {
  return table.source().path || table.empty() ? table.source() : table.begin()->first.source();
}

// What the fields cannot say alone.
void check_together(const PreviewEntry& preview, const toml::table& table) {
  const std::string title = title_of(preview);
  try {
    check_preview(preview);
  } catch (const Error& error) {
    fail(region_of(table), "{}: {}", title, error.what());
  }
  if (preview.second.empty()) {
    const PreviewParams usual;
    for (const auto& [key, set] :
         {std::pair{"pattern", preview.pattern != usual.pattern},
          {"pattern_repeat", preview.pattern_repeat != usual.pattern_repeat}})
      if (set)
        fail(key_region(table, key),
             "{}: '{}' has no effect without 'second': a result is one material", title, key);
    return;
  }
  const toml::source_region& region = key_region(table, "second");
  if (!preview.second.is_name()) {
    if (preview.mapping == Mapping::solid)
      fail(region, "{}: second = '{}': a picture is no solid; allowed is a procedural texture",
           title, preview.second.string());
    return;
  }
  try {
    method_of("procedural", preview.second.string(), {});
  } catch (const Error& error) {
    fail(region, "{}: second: {}", title, error.what());
  }
}

PreviewEntry read_preview(const toml::table& table) {
  check_keys(table, key_names<PreviewEntry>());
  PreviewEntry preview;
  read_fields(preview, table);
  preview.place = place(region_of(table));
  if (table.contains("name"))
    check_name(preview.name, longest_map_name - label.size() - 1, key_region(table, "name"));
  check_together(preview, table);
  return preview;
}

}  // namespace

std::string label_of(const PreviewEntry& preview) {
  return preview.name.empty() ? std::string(label) : fmt::format("{}_{}", label, preview.name);
}

std::string title_of(const PreviewEntry& preview) {
  return preview.name.empty() ? std::string(label) : fmt::format("{} '{}'", label, preview.name);
}

std::vector<PreviewEntry> read_previews(toml::table& config) {
  std::vector<PreviewEntry> previews;
  NamesInUse names;
  bool unnamed = false;
  for (const toml::table* table : tables_of(config, label)) {
    previews.push_back(read_preview(*table));
    if (!previews.back().name.empty())
      names.add(previews.back().name, key_region(*table, "name"));
    else if (std::exchange(unnamed, true))
      fail(table->source(), "a second [[preview]] without a 'name': their files need one");
  }
  return previews;
}

std::vector<const PreviewEntry*> previews_of(const Config& config, const Job& job) {
  std::vector<const PreviewEntry*> previews;
  for (const PreviewEntry& preview : config.previews)
    if (job_matches(preview.only, job_name(config, job))) previews.push_back(&preview);
  return previews;
}

}  // namespace gramloom
