#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gramloom {

/// A page of the manual: "gramloom-run" in section 1 is the file man1/gramloom-run.1.
struct ManualPage {
  std::string name;
  int section = 1;
};
/// The program, each of its commands, and the config.
std::vector<ManualPage> manual_pages(const CLI::App& program);

/// The page as roff: all of it comes from the command line's own descriptions and from the field
/// lists.
std::string manual_text(const CLI::App& program, const ManualPage& page);

}  // namespace gramloom
