#include "commands/option_words.h"

#include <CLI/CLI.hpp>

namespace gramloom {

namespace {

// CLI11 tells the words of one_of as "{a,b}" behind the type.
std::vector<std::string> words_in(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  if (result.names.empty()) result.names.push_back(option.get_name());
  const std::string type = option.get_type_name();
  result.words = words_in(type);
  result.takes_value = option.get_expected_max() > 0 && option.get_type_size_max() > 0;
  if (result.takes_value) result.type = type.substr(0, type.find(':'));
  result.description = option.get_description();
  result.group = option.get_group();
  result.required = option.get_required();
  result.repeated = option.get_items_expected_max() > 1;
  return result;
}

std::vector<OptionWords> words_of(const CLI::App& command, bool positional) {
  std::vector<OptionWords> result;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional() == positional && !option->get_group().empty())
      result.push_back(words_of(*option));
  return result;
}

}  // namespace

std::vector<OptionWords> options_of(const CLI::App& command) { return words_of(command, false); }

std::vector<OptionWords> arguments_of(const CLI::App& command) { return words_of(command, true); }

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

}  // namespace gramloom
