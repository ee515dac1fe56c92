#include "procedural/texture.h"

namespace gramloom {

Texture synthesise(const ProceduralParams& params, const Target& target, Random random,
                   const Control& control) {
  check_fields(params);
  std::visit([](const auto& texture) { check_fields(texture); }, params.texture);
  Texture result{Image(target.size, 3), {}};
  for (int y = 0; y < target.size.height; ++y) {
    control.step(y, target.size.height);
    for (int x = 0; x < target.size.width; ++x)
      for (int c = 0; c < 3; ++c)
        result.image.at(x, y)[c] = random.stream(result.image.index(x, y)).uniform();
  }
  return result;
}

Cost estimate(const ProceduralParams&, const Target& target) {
  const double pixels = double(target.size.width) * target.size.height;
  return {pixels * 32, pixels * 1e-6};
}

}  // namespace gramloom
