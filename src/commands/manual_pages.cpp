#include "commands/manual_pages.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands/examples.h"
#include "commands/option_words.h"
#include "commands/roff.h"
#include "jobs/key_lists.h"
#include "jobs/listing.h"
#include "jobs/machine.h"

namespace gramloom {

namespace {

constexpr const char* config_page = "gramloom-config";

std::string page_name(const CLI::App& command) { return "gramloom-" + command.get_name(); }

// Up to the end of the first sentence, or its first half.
std::string first_sentence(const std::string& text) {
  return text.substr(0, std::min({text.find(". "), text.find("; "), text.find(": ")}));
}

void add_name(Roff& roff, const std::string& name, const std::string& summary) {
  roff.heading("NAME");
  roff.paragraph(fmt::format("{} - {}", name, summary));
}

// With the words that the option may be.
std::string meaning_of(const OptionWords& option) {
  std::string text = option.description;
  if (!option.words.empty()) text += fmt::format("; one of {}", fmt::join(option.words, ", "));
  return text + (option.required ? "; needed" : "");
}

void add_options(Roff& roff, const std::vector<OptionWords>& options) {
  std::string group;
  for (const OptionWords& option : options) {
    if (option.group != group && option.group != "Options") roff.subheading(option.group);
    group = option.group;
    roff.entry(fmt::format("{}", fmt::join(option.names, ", ")),
               option.words.empty() ? option.type : "WORD", meaning_of(option));
  }
}

std::string program_page(const CLI::App& program) {
  Roff roff("gramloom", 1, version());
  add_name(roff, "gramloom", program.get_description());
  roff.heading("SYNOPSIS");
  roff.verbatim("gramloom COMMAND [OPTION]...");
  roff.heading("COMMANDS");
  for (const CLI::App* command : commands_of(program))
    roff.entry(fmt::format("{}(1)", page_name(*command)), "", command->get_description());
  roff.heading("OPTIONS");
  add_options(roff, options_of(program));
  roff.heading("EXIT STATUS");
  roff.paragraph(program.get_footer());
  roff.heading("SEE ALSO");
  roff.paragraph(fmt::format("{}(5)", config_page));
  return roff.text();
}

std::string command_page(const CLI::App& command) {
  Roff roff(page_name(command), 1, version());
  add_name(roff, page_name(command), first_sentence(command.get_description()));
  roff.heading("SYNOPSIS");
  std::string synopsis = fmt::format("gramloom {} [OPTION]...", command.get_name());
  const std::vector<OptionWords> arguments = arguments_of(command);
  for (const OptionWords& argument : arguments) {
    const std::string name = argument.names.front() + (argument.repeated ? "..." : "");
    synopsis += argument.required ? " " + name : fmt::format(" [{}]", name);
  }
  roff.verbatim(synopsis);
  roff.heading("DESCRIPTION");
  roff.paragraph(command.get_description());
  if (!arguments.empty()) roff.heading("ARGUMENTS");
  for (const OptionWords& argument : arguments)
    roff.entry(argument.names.front(), "", meaning_of(argument));
  roff.heading("OPTIONS");
  add_options(roff, options_of(command));
  roff.heading("EXAMPLES");
  roff.verbatim(examples_of(command.get_name()));
  roff.heading("SEE ALSO");
  roff.paragraph(fmt::format("gramloom(1), {}(5)", config_page));
  return roff.text();
}

void add_keys(Roff& roff, const std::vector<Key>& keys) {
  for (const Key& key : keys) {
    const std::string standard = default_text(key);
    roff.entry(key.name, standard.empty() ? "" : "= " + standard,
               fmt::format("{}; {}", meaning_of(key), key.allowed));
  }
}

// What a preset changes: "directions = 24".
std::string changes(const KeyList& preset, const KeyList& method) {
  std::string text;
  for (std::size_t i = 0; i < preset.keys.size(); ++i)
    if (preset.keys[i].standard != method.keys[i].standard && preset.keys[i].name != "preset")
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", preset.keys[i].name,
                          default_text(preset.keys[i]));
  return text.empty() ? "the defaults" : text;
}

std::string config_text() {
  Roff roff(config_page, 5, version());
  add_name(roff, config_page, "what gramloom is to make");
  roff.heading("DESCRIPTION");
  roff.paragraph(
      "A config is a TOML file. Every exemplar × every method × every seed is one texture. Paths "
      "are relative to the config. 'gramloom new' writes a config to start from, 'gramloom check' "
      "says what is wrong with one and what it will take, 'gramloom run' does it.");
  roff.verbatim(
      "seeds = [1, 2]\nsize  = [512, 512]\ntile  = \"both\"\n\n[[exemplar]]\nname  = \"wall\"\n"
      "image = \"wall.jpg\"\n\n[[method]]\nname = \"neural\"\nkind = \"neural\"\npreset = "
      "\"fast\"");
  for (const KeyList& table : table_lists()) {
    roff.heading(table.name.empty() ? "TOP LEVEL" : table.name);
    roff.paragraph(table.summary);
    add_keys(roff, table.keys);
  }
  const std::vector<KeyList> methods = method_lists();
  const std::vector<KeyList> presets = preset_lists();
  for (const KeyList& method : methods) {
    roff.heading("METHOD " + method.name);
    roff.paragraph(method.summary);
    add_keys(roff, method.keys);
    for (const KeyList& preset : presets)
      if (preset.name.starts_with(method.name + ", "))
        roff.entry("preset = " + preset.name.substr(method.name.size() + 2), "",
                   changes(preset, method));
  }
  for (const KeyList& texture : texture_lists()) {
    roff.heading("TEXTURE " + texture.name);
    roff.paragraph(texture.summary);
    add_keys(roff, texture.keys);
  }
  for (const KeyList& model : model_lists()) {
    roff.heading("MODEL " + model.name);
    roff.paragraph(model.summary);
    add_keys(roff, model.keys);
  }
  roff.heading("SEE ALSO");
  roff.paragraph("gramloom(1), gramloom-list(1)");
  return roff.text();
}

}  // namespace

std::vector<ManualPage> manual_pages(const CLI::App& program) {
  std::vector<ManualPage> pages{{"gramloom", 1}};
  for (const CLI::App* command : commands_of(program)) pages.push_back({page_name(*command), 1});
  pages.push_back({config_page, 5});
  return pages;
}

std::string manual_text(const CLI::App& program, const ManualPage& page) {
  if (page.name == config_page) return config_text();
  for (const CLI::App* command : commands_of(program))
    if (page_name(*command) == page.name) return command_page(*command);
  return program_page(program);
}

}  // namespace gramloom
