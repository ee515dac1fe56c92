// The JSON files of a run.
#include "fuzz.h"
#include "runs/comparison.h"
#include "runs/format.h"
#include "runs/run_record.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  const auto read = [&]<class T>() {
    read_or_refuse([&] { format_from_json<T>(parse_json(text), "f.json"); });
  };
  read.operator()<JobRecord>();
  read.operator()<RunRecord>();
  read.operator()<ComparisonRecord>();
  read.operator()<SeedDiversity>();
  return 0;
}
