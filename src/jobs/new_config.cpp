#include "jobs/new_config.h"

#include <algorithm>
#include <set>

#include "io/models_folder.h"
#include "io/text_file.h"
#include "jobs/key_lists.h"
#include "jobs/names.h"
#include "jobs/plan.h"
#include "jobs/protected_files.h"
#include "jobs/text_table.h"
#include "jobs/written_config.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// Photographs have more pixels than a texture's features need, and than one waits for.
constexpr int enough_pixels = 1024;

// A key with its value and what it means; `mark` is "# " where the line is only a proposal.
Row line_of(const Key& key, std::string_view mark, const std::string& value) {
  return {fmt::format("{}{}", mark, key.name), "= " + value,
          fmt::format("# {}; {}", meaning_of(key), key.allowed)};
}

KeyList named(const std::vector<KeyList>& lists, std::string_view name) {
  return *std::ranges::find(lists, name, &KeyList::name);
}

std::string top_section(const std::vector<KeyList>& tables) {
  const std::map<std::string, std::string> values{
      {"seeds", "[1, 2]"}, {"size", "[512, 512]"}, {"tile", "\"both\""}};
  std::vector<Row> rows;
  for (const Key& key : tables.front().keys)
    if (const auto value = values.find(key.name); value != values.end())
      rows.push_back(line_of(key, "", value->second));
    else if (const std::string standard = default_text(key); !standard.empty())
      rows.push_back(line_of(key, "# ", standard));
  return text_table(rows, "");
}

// Below the config's folder by its path from there, so that the folder can be moved as a whole.
std::string path_text(const fs::path& picture, const fs::path& config) {
  const fs::path whole = fs::absolute(picture).lexically_normal();
  const fs::path relative =
      whole.lexically_relative(fs::absolute(config).lexically_normal().parent_path());
  const bool is_below = !relative.empty() && *relative.begin() != "..";
  return quoted((is_below ? relative : whole).generic_string());
}

// Like the picture or the folder, and each once.
std::string new_name(const fs::path& picture, std::set<std::string>& names) {
  const fs::path whole = fs::absolute(picture).lexically_normal();
  const std::string name = exemplar_name(whole.has_filename() ? whole : whole.parent_path());
  std::string free = name;
  for (int number = 2; !names.insert(in_small_letters(free)).second; ++number)
    free = fmt::format("{}_{}", name, number);
  return free;
}

std::string exemplar_sections(const std::vector<fs::path>& pictures, const fs::path& file,
                              const std::vector<KeyList>& tables, bool shrink) {
  const std::vector<Key> keys = named(tables, "[[exemplar]]").keys;
  const auto row = [&](std::string_view name, std::string_view mark, const std::string& value) {
    return line_of(*std::ranges::find(keys, name, &Key::name), mark, value);
  };
  std::string text;
  std::set<std::string> names;
  for (const fs::path& picture : pictures) {
    const std::string key = fs::is_directory(picture) ? "folder" : "image";
    text += "\n[[exemplar]]\n" +
            text_table({row("name", "", quoted(new_name(picture, names))),
                        row(key, "", path_text(picture, file)),
                        row("max_side", shrink ? "" : "# ", std::to_string(enough_pixels))},
                       "");
  }
  return text;
}

// A method with some of its keys, or all, as proposals.
struct Proposal {
  std::string kind;
  std::string preset;
  std::vector<std::string> keys;
  std::string comment;
};

std::string method_section(const Proposal& proposal) {
  const KeyList list = proposal.preset.empty()
                           ? named(method_lists(), proposal.kind)
                           : named(preset_lists(), proposal.kind + ", " + proposal.preset);
  std::vector<Row> rows;
  const KeyList first = named(table_lists(), "[[method]]");
  for (const Key& key : first.keys) rows.push_back(line_of(key, "", quoted(proposal.kind)));
  for (const Key& key : list.keys) {
    if (key.name == "preset")
      rows.push_back(line_of(key, "", quoted(proposal.preset)));
    else if (proposal.keys.empty() ||
             std::ranges::find(proposal.keys, key.name) != proposal.keys.end())
      rows.push_back(line_of(key, "# ", default_text(key)));
  }
  return fmt::format("\n# {}\n[[method]]\n", proposal.comment) + text_table(rows, "");
}

std::string config_text(const std::vector<fs::path>& pictures, const fs::path& file, bool shrink) {
  const std::vector<KeyList> tables = table_lists();
  std::string text = fmt::format(
      "# Every exemplar × every method × every seed is one texture.\n#\n"
      "#   gramloom check {0}     what it will take\n"
      "#   gramloom run {0}       makes all, and a page that shows them\n#\n"
      "# Keys behind a # are proposals, parameters with their defaults: take the # away and "
      "change\n"
      "# them. All keys stand in the manual: man gramloom-config.\n\n",
      file.filename().string());
  text += top_section(tables) + exemplar_sections(pictures, file, tables, shrink);
  text += method_section({"neural",
                          "fast",
                          {"directions", "iterations", "layout", "coarsest_side"},
                          "Invents new pieces. balanced takes five times as long, quality ten."});
  text += method_section(
      {"quilting", "", {}, "Lays pieces of the exemplar side by side: for bricks, tiles, weaves."});
  text += method_section({"patchmatch", "", {}, "Blends pieces that overlap: few seams."});
  return text;
}

// The plan of a config that can be run as it is.
Plan checked_plan(const std::string& text, const fs::path& file) {
  Plan plan = make_plan(parse_unseen_config(text, file));
  for (const PlannedJob& job : plan.jobs)
    if (!job.error.empty()) throw ConfigError("{}", job.error);
  return plan;
}

void check_new_file(const fs::path& file) {
  if (file.extension() != ".toml")
    throw ConfigError("{}: the name of a config ends with .toml", file.string());
  if (is_there(file)) throw ConfigError("{} is there already: choose another name", file.string());
  if (const fs::path folder = fs::absolute(file).parent_path(); !fs::is_directory(folder))
    throw ConfigError("{}: there is no folder {}", file.string(), folder.string());
}

}  // namespace

void write_new_config(const fs::path& file, const std::vector<fs::path>& pictures) {
  check_new_file(file);
  const std::vector<fs::path> from =
      pictures.empty() ? std::vector{models_folder().parent_path() / "data" / "pebbles.png"}
                       : pictures;
  for (const fs::path& picture : from)
    if (!fs::exists(picture))
      throw ConfigError("--from {}: there is no such picture or folder", picture.string());
  std::string text = config_text(from, file, false);
  const Plan plan = checked_plan(text, file);
  const bool shrink = std::ranges::any_of(plan.exemplars, [](const ExemplarFacts& facts) {
    const Size size = facts.request.exemplars.front().size;
    return std::max(size.width, size.height) > enough_pixels;
  });
  if (shrink) {
    text = config_text(from, file, true);
    checked_plan(text, file);
  }
  write_text(file, text);
}

}  // namespace gramloom
