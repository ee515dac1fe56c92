#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gramloom {

// What the command line knows of itself, for the manual and for completions.

/// An option, or an argument that is known by its place.
struct OptionWords {
  std::vector<std::string> names;  // "--tile"; of an argument, its name
  std::string type;                // "FILE"; "" of a flag, and of one of `words`
  std::vector<std::string> words;  // those that it may be, if it is one of some
  std::string description;
  std::string group;
  bool takes_value = false;
  bool required = false;
  bool repeated = false;  // several values may follow
};
std::vector<OptionWords> options_of(const CLI::App& command);
std::vector<OptionWords> arguments_of(const CLI::App& command);

/// The commands of the program, in its order.
std::vector<const CLI::App*> commands_of(const CLI::App& program);

}  // namespace gramloom
