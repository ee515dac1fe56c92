#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace gramloom {

/// The commands that the text of --help names.
inline std::vector<std::string> commands_in(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help);
  bool are_commands = false;
  for (std::string line; std::getline(lines, line);) {
    if (are_commands && line.starts_with("  ") && line[2] != ' ')
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    are_commands |= line.starts_with("Subcommands");
  }
  return names;
}

}  // namespace gramloom
