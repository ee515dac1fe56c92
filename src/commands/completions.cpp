#include "commands/completions.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "commands/option_words.h"
#include "io/models_folder.h"
#include "jobs/key_lists.h"
#include "jobs/listing.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

std::vector<Candidate> words_of(const std::vector<std::string>& words) {
  std::vector<Candidate> candidates;
  for (const std::string& word : words) candidates.push_back({word, ""});
  return candidates;
}

std::vector<Candidate> names_of(const std::vector<KeyList>& lists) {
  std::vector<Candidate> candidates;
  for (const KeyList& list : lists) candidates.push_back({list.name, list.summary});
  return candidates;
}

std::vector<Candidate> trained_models() {
  std::vector<Candidate> candidates;
  for (const fs::path& file : models_in_folder(".safetensors"))
    candidates.push_back({file.stem().string(), ""});
  return candidates;
}

void append(std::vector<Candidate>& candidates, std::vector<Candidate> more) {
  std::ranges::move(more, std::back_inserter(candidates));
}

// Files whose path begins with `word`, and folders.
std::vector<Candidate> files_like(const std::string& word, const std::string& extension) {
  const std::string folder = word.substr(0, word.rfind('/') + 1);
  std::vector<Candidate> candidates;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    if (entry.is_directory(failure))
      candidates.push_back({folder + name + "/", ""});
    else if (extension.empty() || entry.path().extension() == extension)
      candidates.push_back({folder + name, ""});
  }
  return candidates;
}

// The keys of methods, each once; of `make` and `preview` those that the command takes.
std::vector<Key> parameters_for(std::string_view command) {
  std::vector<Key> keys;
  const auto add = [&](const std::vector<KeyList>& lists) {
    for (const KeyList& list : lists)
      for (const Key& key : list.keys)
        if (std::ranges::find(keys, key.name, &Key::name) == keys.end()) keys.push_back(key);
  };
  if (command != "preview") add(method_lists());
  add(texture_lists());
  return keys;
}

// "size", "directions", "surface.normal": all that --set of the command can be given.
std::vector<Key> settable_keys(std::string_view command) {
  std::vector<Key> keys;
  if (command != "make" && command != "preview") {
    for (const KeyList& table : table_lists()) {
      if (table.name.starts_with("[[")) continue;
      const std::string prefix =
          table.name.empty() ? "" : table.name.substr(1, table.name.size() - 2) + ".";
      for (Key key : table.keys) {
        key.name = prefix + key.name;
        keys.push_back(std::move(key));
      }
    }
  }
  std::ranges::move(parameters_for(command), std::back_inserter(keys));
  return keys;
}

std::vector<Candidate> values_of(const Key& key) {
  if (key.name == "network") return words_of(network_names());
  if (key.name == "model") return trained_models();
  return words_of(key.words);
}

// "key=" of each key, or the values of the key that stands there already.
std::vector<Candidate> settings_like(const std::string& word, std::string_view command) {
  std::vector<Candidate> candidates;
  const std::vector<Key> keys = settable_keys(command);
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) {
    for (const Key& key : keys) candidates.push_back({key.name + "=", meaning_of(key)});
    return candidates;
  }
  std::string name = word.substr(0, equals);
  if (name.starts_with("method.")) name.erase(0, name.rfind('.') + 1);
  const auto key = std::ranges::find(keys, name, &Key::name);
  if (key == keys.end()) return {};
  for (Candidate& value : candidates = values_of(*key))
    value.word.insert(0, word.substr(0, equals + 1));
  return candidates;
}

std::vector<Candidate> arguments_like(const std::string& word, const CLI::App& command) {
  std::vector<Candidate> candidates;
  const std::vector<OptionWords> arguments = arguments_of(command);
  if (arguments.empty()) return {};
  const OptionWords& argument = arguments.front();
  const std::string& name = argument.names.front();
  if (!argument.words.empty()) return words_of(argument.words);
  if (name == "config") return files_like(word, ".toml");
  if (name == "model") candidates = trained_models();
  if (name == "exemplars" || name == "images") candidates = names_of(texture_lists());
  if (!candidates.empty()) append(candidates, files_like(word, ""));
  return candidates;
}

std::vector<Candidate> option_names(const CLI::App& command) {
  std::vector<Candidate> candidates;
  for (const OptionWords& option : options_of(command))
    for (const std::string& name : option.names)
      if (name.starts_with("--")) candidates.push_back({name, option.description});
  return candidates;
}

std::vector<Candidate> candidates_for(const CLI::App& program,
                                      const std::vector<std::string>& words) {
  const std::string& word = words.back();
  std::vector<Candidate> candidates;
  if (words.size() == 1) {
    if (word.starts_with('-')) return option_names(program);
    for (const CLI::App* command : commands_of(program))
      candidates.push_back({command->get_name(), command->get_description()});
    return candidates;
  }
  const auto commands = commands_of(program);
  const auto command = std::ranges::find_if(
      commands, [&](const CLI::App* one) { return one->get_name() == words.front(); });
  if (command == commands.end()) return {};
  for (const OptionWords& option : options_of(**command)) {
    if (!option.takes_value ||
        std::ranges::find(option.names, words[words.size() - 2]) == option.names.end())
      continue;
    if (option.names.back() == "--set") return settings_like(word, words.front());
    return words_of(option.words);
  }
  return word.starts_with('-') ? option_names(**command) : arguments_like(word, **command);
}

}  // namespace

std::vector<Candidate> completions_of(const CLI::App& program,
                                      const std::vector<std::string>& words) {
  if (words.empty()) return {};
  std::vector<Candidate> candidates = candidates_for(program, words);
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return !candidate.word.starts_with(words.back());
  });
  return candidates;
}

}  // namespace gramloom
