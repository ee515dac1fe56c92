// Several methods on one exemplar: methods EXEMPLAR FOLDER
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <variant>
#include <vector>

#include "classic/patchmatch.h"
#include "classic/phase.h"
#include "classic/pyramid.h"
#include "classic/quilting.h"
#include "core/error.h"
#include "io/image_file.h"
#include "metrics/exemplar_statistics.h"
#include "metrics/scores.h"

int main(int count, char** arguments) try {
  using namespace gramloom;
  if (count != 3) throw Error("methods EXEMPLAR FOLDER");
  const ImageFile exemplar = read_image(arguments[1]);
  ExemplarStatistics statistics(exemplar.image);
  const Request request{.exemplars = {{exemplar.image}}, .target = {{192, 192}, Tile::both}};

  using Method = std::variant<QuiltingParams, PatchmatchParams, PyramidParams, PhaseParams>;
  const std::vector<Method> methods{QuiltingParams{.patch_size = 24}, PatchmatchParams{},
                                    PyramidParams{}, PhaseParams{}};
  for (const Method& method : methods)
    std::visit(
        [&](const auto& params) {
          const auto start = std::chrono::steady_clock::now();
          const Texture texture = synthesise(params, request, {});
          const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
          const std::string name(params.kind);
          write_image(std::filesystem::path(arguments[2]) / (name + ".png"), texture.image,
                      exemplar.encoding);
          const Scores scores = score(statistics, texture.image, request.target.tile);
          const auto& [score_name, value] = scores.values.front();
          std::printf("%-12s %6.2f s   %s %.4f\n", name.c_str(), time.count(),
                      std::string(score_name).c_str(), value);
        },
        method);
} catch (const gramloom::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
