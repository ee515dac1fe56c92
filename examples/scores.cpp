// How like an exemplar are these pictures, and what did they copy? scores EXEMPLAR PICTURE...
#include "metrics/scores.h"

#include <cstdio>

#include "core/error.h"
#include "io/image_file.h"
#include "metrics/exemplar_statistics.h"

int main(int count, char** arguments) try {
  using namespace gramloom;
  if (count < 3) throw Error("scores EXEMPLAR PICTURE...");
  ExemplarStatistics exemplar(read_image(arguments[1]).image);  // once for all pictures
  for (int i = 2; i < count; ++i) {
    std::printf("%s\n", arguments[i]);
    const Scores scores = score(exemplar, read_image(arguments[i]).image, Tile::both);
    for (const auto& [name, value] : scores.values)
      std::printf("  %-20s %.4f\n", std::string(name).c_str(), value);
  }
} catch (const gramloom::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
