// Values of --set.
#include "fuzz.h"
#include "jobs/config.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  constexpr auto config =
      "seeds = [1]\n[[exemplar]]\nname = \"e\"\nimage = \"e.png\"\n"
      "[[method]]\nname = \"n\"\nkind = \"neural\"\n[[method]]\nname = \"p\"\nkind = "
      "\"patchmatch\"\n";
  read_or_refuse([&] { parse_config(config, "/nowhere/c.toml", {text}); });
  return 0;
}
