#include "commands/examples.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gramloom {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 21> examples{{
    {"make",
     "gramloom make pebbles.jpg --output new.png\n"
     "gramloom make bricks.jpg --kind quilting --set patch_size=64 --size 1024x512 --output "
     "wall.png\n"
     "gramloom make brick --seed 7 --output brick.png\n"
     "gramloom make pebbles.jpg --print-config > pebbles.toml\n"},
    {"run",
     "gramloom run mine.toml\n"
     "gramloom run mine.toml --resume --jobs 2\n"
     "gramloom run mine.toml --only \"brick/quilting\" --set method.quilting.patch_size=48\n"
     "gramloom run mine.toml --output /shared/mine --shard 3/16\n"},
    {"new", "gramloom new mine.toml --from photographs\n"},
    {"train",
     "gramloom train mine.toml\n"
     "gramloom train mine.toml --resume\n"},
    {"generate", "gramloom generate pebbles --size 4096x2048 --output ground.png\n"},
    {"check",
     "gramloom check mine.toml\n"
     "gramloom check mine.toml --json\n"},
    {"list",
     "gramloom list methods\n"
     "gramloom list patterns --json\n"},
    {"score", "gramloom score pebbles.jpg new.png other.png --tile both\n"},
    {"report", "gramloom report out/mine\n"},
    {"pick", "gramloom pick out/mine pebbles/neural/seed2 bricks/quilting/seed1 --output best\n"},
    {"maps",
     "gramloom maps bricks_height.png --normal --occlusion --tile both --output maps\n"
     "gramloom maps wall.jpg --from-photo --corners 16,20,490,11,501,380,9,371 --output wall\n"},
    {"preview",
     "gramloom preview wall.png wall_normal.png --shape cube --repeat 2 --output cube.png\n"
     "gramloom preview pebbles.png --displacement 0.08 --output ball.png\n"},
    {"tile", "gramloom tile gravel.jpg --size 16384x16384 --output floor.png\n"},
    {"fill",
     "gramloom fill photo.png --mask hole.png --output whole.png\n"
     "gramloom fill photo.png --extend 64 --output larger.png\n"
     "gramloom fill photo.png --seamless both --output tile.png\n"},
    {"arrange", "gramloom arrange seed1_coordinates.tif wall_height.png --output height.png\n"},
    {"export",
     "gramloom export out/mine --target gltf --output materials\n"
     "gramloom export pebbles --target glsl --output pebbles.glsl\n"},
    {"benchmark",
     "gramloom benchmark out/mine\n"
     "gramloom benchmark out/mine --peer other=their_pictures --markdown\n"},
    {"simulate", "gramloom simulate sleeve.toml --output out/sleeve\n"},
    {"infer", "gramloom infer sleeve.safetensors --pose 70,30,-20 --output folds.exr\n"},
    {"manual", "gramloom manual gramloom-config | man -l -\n"},
    {"completion", "source <(gramloom completion bash)\n"},
}};

}  // namespace

std::string_view examples_of(std::string_view command) {
  const auto found = std::ranges::find(examples, command, &decltype(examples)::value_type::first);
  return found == examples.end() ? std::string_view() : found->second;
}

}  // namespace gramloom
