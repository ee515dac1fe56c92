#include "jobs/job_config.h"

#include <algorithm>

#include "jobs/settings.h"
#include "jobs/written_config.h"

namespace gramloom {

namespace {

// The top of the config, but for its seeds.
std::string top_lines(const Config& config) {
  std::string lines;
  for_each_value(config, [&](const FieldText& field, const auto& value) {
    const bool follows = field.name == "seeds" || (field.name == "size" && config.direction.fill);
    if (!follows) add_line(field, value, lines);
  });
  return lines;
}

// The lines of a section that are not as they are without it: some of its keys need others.
template <class Struct>
std::string lines_that_say_more(const Struct& value) {
  std::string lines;
  for_each_field<Struct>([&](const auto& field) {
    const std::string text = value_in_config(value.*field.member);
    if (!text.empty() && text != value_in_config(Struct().*field.member))
      lines += fmt::format("{} = {}\n", field.name, text);
  });
  return lines;
}

std::string section_of(const std::string& head, const std::string& lines) {
  return fmt::format("\n{}\n{}", head, lines);
}

std::string picture_table(const ExemplarPicture& picture) {
  std::string fields;
  for_each_value(picture, [&](const FieldText& field, const auto& value) {
    if (const std::string text = value_in_config(value); !text.empty())
      fields += fmt::format("{}{} = {}", fields.empty() ? "" : ", ", field.name, text);
  });
  return "{ " + fields + " }";
}

std::string exemplar_section(const ExemplarEntry& exemplar) {
  std::string lines = fmt::format("name = {}\n", quoted(exemplar.name));
  if (exemplar.more.empty()) return section_of("[[exemplar]]", lines + lines_in_config(exemplar));
  std::string pictures;
  for (const ExemplarPicture& picture : pictures_of(exemplar))
    pictures += (pictures.empty() ? "" : ", ") + picture_table(picture);
  lines += fmt::format("images = [{}]\n", pictures);
  if (exemplar.max_side) lines += fmt::format("max_side = {}\n", *exemplar.max_side);
  return section_of("[[exemplar]]", lines);
}

// Of the job: it needs no word of which jobs.
std::string preview_section(const PreviewEntry& preview, std::size_t count) {
  PreviewEntry own = preview;
  own.only.clear();
  return section_of(count > 1 ? "[[preview]]" : "[preview]", lines_in_config(own));
}

// That of the job, or that which its texture is scored against.
const ExemplarEntry* exemplar_of(const Config& config, const Job& job) {
  if (job.exemplar) return &config.exemplars[*job.exemplar];
  const std::string name = compared_with(config.methods[job.method].method);
  const auto found = std::ranges::find(config.exemplars, name, &ExemplarEntry::name);
  return found == config.exemplars.end() ? nullptr : &*found;
}

std::string method_section(const MethodEntry& entry) {
  std::string lines = fmt::format("name = {}\nkind = {}\n", quoted(entry.name),
                                  quoted(std::string(kind_of(entry.method))));
  std::visit(
      [&]<class Params>(const Params& params) {
        if constexpr (HasVariant<Params>)
          lines +=
              fmt::format("{} = {}\n", Params::variant_key,
                          std::visit([]<class T>(const T&) { return quoted(std::string(T::name)); },
                                     params.texture));
        for_each_parameter(params, [&](const FieldText& field, const auto& value) {
          add_line(field, value, lines);
        });
      },
      entry.method);
  return section_of("[[method]]", lines);
}

}  // namespace

std::string job_config(const Config& config, const Job& job) {
  std::string text = fmt::format("seeds = [{}]\n", job.seed) + top_lines(config);
  const std::vector<const PreviewEntry*> previews = previews_of(config, job);
  for_each_direction(config.direction, [&]<class Entry>(const std::optional<Entry>& entry) {
    if (entry) text += section_of(fmt::format("[{}]", Entry::section), lines_that_say_more(*entry));
  });
  if (makes_maps(config, job)) text += section_of("[surface]", lines_in_config(config.surface));
  for (const PreviewEntry* preview : previews) text += preview_section(*preview, previews.size());
  if (const ExemplarEntry* exemplar = exemplar_of(config, job); exemplar && !exemplar->is_filled)
    text += exemplar_section(*exemplar);
  return text + method_section(config.methods[job.method]);
}

Json settings_by_content(Json settings) {
  // Files of a list are numbered: "environment_0".
  const auto forget = [](Json& table, Json files) {  // a copy: they may be of the table itself
    for (const auto& [key, hash] : files.items()) {
      table.erase(key);
      table.erase(key.substr(0, key.rfind('_')));
    }
  };
  if (!settings.is_object()) return settings;
  if (settings.contains("files")) forget(settings["method"], settings["files"]);
  if (settings.contains("preview") && settings["preview"].contains("files"))
    forget(settings["preview"], settings["preview"]["files"]);
  if (settings.contains("previews"))
    for (Json& preview : settings["previews"])
      if (preview.contains("files")) forget(preview, preview["files"]);
  return settings;
}

}  // namespace gramloom
