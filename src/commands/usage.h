#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
class Validator;
}  // namespace CLI

namespace gramloom {

// What is said of a command line that cannot be read.

/// Of an option or argument that is one of `words`.
CLI::Validator one_of(std::vector<std::string> words);

/// What is wrong with the command line that `program` could not read: the word that it does not
/// know with the one that may be meant, what is missing, or what the command line's library says.
std::string usage_mistake(const CLI::App& program, const CLI::ParseError& error);

}  // namespace gramloom
