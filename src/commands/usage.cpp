#include "commands/usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands/option_words.h"
#include "core/fields.h"

namespace gramloom {

namespace {

// "; did you mean 'quilting'?", or "". Of one letter every other would be as close.
std::string proposal(const std::string& word, const std::vector<std::string>& words) {
  const std::string guess = word.size() > 1 ? closest_word(word, words) : "";
  return guess.empty() ? "" : fmt::format("; did you mean '{}'?", guess);
}

std::string unknown_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(program)) names.push_back(command->get_name());
  return fmt::format("there is no command '{}'{}", word, proposal(word, names));
}

// "make: ", and nothing of the program itself.
std::string place(const CLI::App& command) {
  return command.get_parent() ? command.get_name() + ": " : "";
}

std::string unknown_option(const CLI::App& command, const std::string& word) {
  const std::string option = word.substr(0, word.find('='));
  std::vector<std::string> names;
  for (const OptionWords& known : options_of(command))
    names.insert(names.end(), known.names.begin(), known.names.end());
  return fmt::format("{}there is no option '{}'{}", place(command), option,
                     proposal(option, names));
}

// What must be given and was not; "" if nothing.
std::string missing_option(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && option->count() == 0)
      return fmt::format("{}needed is '{}': {}", place(command), option->get_name(),
                         option->get_description());
  return "";
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string known = fmt::format("{{{}}}", fmt::join(words, ","));
  const auto check = [words = std::move(words)](const std::string& word) -> std::string {
    if (std::ranges::find(words, word) != words.end()) return "";
    return fmt::format("there is no '{}'; allowed are {}{}", word, fmt::join(words, ", "),
                       proposal(word, words));
  };
  return {check, known};
}

std::string usage_mistake(const CLI::App& program, const CLI::ParseError& error) {
  const auto asked = program.get_subcommands();
  const CLI::App& command = asked.empty() ? program : *asked.front();
  std::vector<std::string> left = program.remaining();
  if (!left.empty() && !left.front().starts_with('-')) return unknown_command(program, left[0]);
  if (!left.empty()) return unknown_option(program, left.front());
  left = command.remaining();
  const auto option =
      std::ranges::find_if(left, [](const std::string& word) { return word.starts_with('-'); });
  if (option != left.end()) return unknown_option(command, *option);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    return asked.empty() ? "needed is a command" : missing_option(command);
  if (!left.empty()) return fmt::format("{}'{}' is one word too many", place(command), left[0]);
  return error.what();
}

}  // namespace gramloom
