// A block of marble, cut twice: marble RESULT OTHER_RESULT
#include <cstdio>

#include "core/error.h"
#include "io/image_file.h"
#include "procedural/texture.h"

int main(int count, char** arguments) try {
  using namespace gramloom;
  if (count != 3) throw Error("marble RESULT OTHER_RESULT");
  ProceduralParams params;
  params.texture = Marble{};
  params.scale = 4;  // features along the shorter side
  const Request request{.target = {{384, 256}}};
  write_image(arguments[1], synthesise(params, request, {}).image, {});

  params.depth = 0.5;  // the same stone, half a feature further in
  write_image(arguments[2], synthesise(params, request, {}).image, {});
} catch (const gramloom::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
