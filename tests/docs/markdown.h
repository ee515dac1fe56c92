#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace gramloom {

/// A comment on the lines above a block of code, <!-- WORD: TEXT -->: how the block is tested
/// (commands_test.cpp).
struct Note {
  std::string word, text;
};

/// A block of code between fences.
struct CodeBlock {
  std::string language;  // "" if none is said
  std::string text;
  int line = 0;  // of its fence, from 1
  std::vector<Note> notes;
};

/// A link or a picture: [words](target).
struct Link {
  std::string target;
  int line = 0;
};

/// A Markdown file, as far as the tests ask.
struct Page {
  std::filesystem::path file;
  std::vector<CodeBlock> blocks;
  std::vector<Link> links;         // outside code
  std::vector<Link> code;          // `words in code` outside blocks
  std::set<std::string> headings;  // as anchors, the way GitHub makes them
};

Page read_page(const std::filesystem::path& file);

/// Every Markdown file of the project, README.md first.
std::vector<std::filesystem::path> markdown_files();

}  // namespace gramloom
