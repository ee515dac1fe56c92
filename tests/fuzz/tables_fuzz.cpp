// Tables: traces, scores, poses.
#include "fuzz.h"
#include "jobs/pose_table.h"
#include "runs/csv.h"
#include "runs/score_sheet.h"
#include "runs/trace_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  read_or_refuse([&] { parse_csv(text); });
  read_or_refuse([&] { parse_trace(text); });
  read_or_refuse([&] { parse_score_sheet(text); });
  read_or_refuse([&] { read_pose_table(file_of(text, ".csv")); });
  return 0;
}
