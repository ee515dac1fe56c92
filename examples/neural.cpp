// Neural synthesis that says how far it is and may be stopped: neural EXEMPLAR RESULT
#include <chrono>
#include <cstdio>

#include "core/error.h"
#include "io/image_file.h"
#include "neural/synthesis.h"

int main(int count, char** arguments) try {
  using namespace gramloom;
  if (count != 3) throw Error("neural EXEMPLAR RESULT");
  const ImageFile exemplar = read_image(arguments[1]);
  const NeuralParams params = with_preset(Preset::fast);
  const Request request{.exemplars = {{exemplar.image}}, .target = {{128, 128}, Tile::both}};
  std::printf("expected: %.0f s\n", seconds(estimate(params, size_of(request)).work));

  Control control;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  control.progress = [&](const Progress& p) {
    if (p.step % 25 == 0)
      std::printf("step %ld of %ld, loss %.4g\n", long(p.step), long(p.steps), p.loss);
    return std::chrono::steady_clock::now() < end;  // false: stop with what there is
  };
  const Texture texture = synthesise(params, request, control);
  write_image(arguments[2], texture.image, exemplar.encoding);
} catch (const gramloom::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
