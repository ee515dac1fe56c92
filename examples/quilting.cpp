// A texture that tiles, from a picture of one: quilting EXEMPLAR RESULT
#include "classic/quilting.h"

#include <cstdio>

#include "core/error.h"
#include "io/image_file.h"

int main(int count, char** arguments) try {
  using namespace gramloom;
  if (count != 3) throw Error("quilting EXEMPLAR RESULT");
  const ImageFile exemplar = read_image(arguments[1]);
  const Request request{.exemplars = {{exemplar.image}}, .target = {{512, 512}, Tile::both}};
  const Texture wall = synthesise(QuiltingParams{.patch_size = 64}, request, {});
  write_image(arguments[2], wall.image, exemplar.encoding);
} catch (const gramloom::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
