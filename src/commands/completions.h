#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gramloom {

/// A word that may stand where the cursor is, and what it means.
struct Candidate {
  std::string word;  // ends with = or / where more must follow
  std::string meaning;
};

/// What may complete the last of `words`, those of a command line after "gramloom". None: a file's
/// name, as far as the shell knows them.
std::vector<Candidate> completions_of(const CLI::App& program,
                                      const std::vector<std::string>& words);

}  // namespace gramloom
