// Config files.
#include "fuzz.h"
#include "jobs/config.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  read_or_refuse([&] { parse_config(text, "/nowhere/c.toml"); });
  return 0;
}
