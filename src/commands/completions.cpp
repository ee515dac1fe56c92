#include "commands/completions.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "commands/manual_pages.h"
#include "commands/option_words.h"
#include "commands/written_words.h"
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

bool is_option(const OptionWords& option, const std::string& word) {
  return std::ranges::find(option.names, word) != option.names.end();
}

// What stands between the command and the word that is to be completed: the value of an option, the
// last one given, and what has its place. "" for none.
std::string given_value(const std::vector<std::string>& words, const std::string& option) {
  std::string value;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    if (words[i] == option && i + 2 < words.size()) value = words[i + 1];
    if (words[i].starts_with(option + "=")) value = words[i].substr(option.size() + 1);
  }
  return value;
}

std::string given_argument(const std::vector<std::string>& words, const CLI::App& command) {
  const std::vector<OptionWords> options = options_of(command);
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    if (!words[i].starts_with('-')) return words[i];
    if (std::ranges::any_of(options, [&](const OptionWords& option) {
          return option.takes_value && is_option(option, words[i]);
        }))
      ++i;
  }
  return "";
}

// The keys of methods, each once; of `make` and `preview` those that the command takes. With a
// kind of method those of that kind.
std::vector<Key> parameters_for(std::string_view command, const std::string& kind) {
  const std::vector<KeyList> methods = method_lists();
  const auto chosen = std::ranges::find(methods, kind, &KeyList::name);
  if (chosen != methods.end()) return chosen->keys;
  std::vector<Key> keys;
  const auto add = [&](const std::vector<KeyList>& lists) {
    for (const KeyList& list : lists)
      for (const Key& key : list.keys)
        if (std::ranges::find(keys, key.name, &Key::name) == keys.end()) keys.push_back(key);
  };
  if (command != "preview") add(methods);
  add(texture_lists());
  return keys;
}

// "size", "directions", "surface.normal": all that --set of the command can be given.
std::vector<Key> settable_keys(std::string_view command, const std::string& kind) {
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
  std::ranges::move(parameters_for(command, kind), std::back_inserter(keys));
  return keys;
}

std::vector<Candidate> values_of(const Key& key) {
  if (key.name == "network") return words_of(network_names());
  if (key.name == "model") return trained_models();
  return words_of(key.words);
}

// The presets of the kind of method that stands there already: some have none.
std::vector<Candidate> presets_for(const std::vector<std::string>& words,
                                   const OptionWords& option) {
  const std::vector<Key> keys = parameters_for(words.front(), given_value(words, "--kind"));
  const bool has_presets = std::ranges::find(keys, "preset", &Key::name) != keys.end();
  return has_presets ? words_of(option.words) : std::vector<Candidate>();
}

// "key=" of each key, or the values of the key that stands there already.
std::vector<Candidate> settings_like(const std::vector<std::string>& words,
                                     const CLI::App& command) {
  const std::string& word = words.back();
  std::vector<Candidate> candidates;
  const std::vector<Key> keys = settable_keys(words.front(), given_value(words, "--kind"));
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos && word.starts_with("method."))
    return settings_of_methods(given_argument(words, command));
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

std::vector<Candidate> pages_of(const CLI::App& program) {
  std::vector<Candidate> candidates;
  for (const ManualPage& page : manual_pages(program)) candidates.push_back({page.name, ""});
  return candidates;
}

std::vector<Candidate> arguments_like(const std::vector<std::string>& words,
                                      const CLI::App& command) {
  const std::string& word = words.back();
  std::vector<Candidate> candidates;
  const std::vector<OptionWords> arguments = arguments_of(command);
  if (arguments.empty()) return {};
  const OptionWords& argument = arguments.front();
  const std::string& name = argument.names.front();
  if (!argument.words.empty()) return words_of(argument.words);
  if (name == "page") return pages_of(*command.get_parent());
  if (const std::string run = given_argument(words, command);
      !run.empty() && command.get_name() == "pick")
    return jobs_of_run(run);
  if (name == "config") return files_like(word, ".toml");
  if (name == "model") candidates = trained_models();
  if (name == "exemplars" || name == "images") candidates = names_of(texture_lists());
  if (!candidates.empty()) append(candidates, files_like(word, ""));
  return candidates;
}

// The jobs of the config, or of the run, that stands there already.
std::vector<Candidate> jobs_like(const std::vector<std::string>& words, const CLI::App& command) {
  const std::string file = given_argument(words, command);
  return fs::is_directory(file) ? jobs_of_run(file) : jobs_of_config(file);
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
    if (!option.takes_value || !is_option(option, words[words.size() - 2])) continue;
    const std::string& name = option.names.back();
    if (name == "--set") return settings_like(words, **command);
    if (name == "--preset") return presets_for(words, option);
    if (name == "--only") return jobs_like(words, **command);
    return words_of(option.words);
  }
  return word.starts_with('-') ? option_names(**command) : arguments_like(words, **command);
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
