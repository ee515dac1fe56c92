#include "runs/record.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace gramloom {
namespace {

TEST(Record, NotesComeBack) {
  const auto file =
      std::filesystem::temp_directory_path() / fmt::format("gramloom_record_{}.json", getpid());
  JobRecord record;
  record.settings = Json::object();
  write_record(file, record);
  EXPECT_TRUE(read_record(file).notes.empty());
  record.notes = {"h.tif: a", "seed1.png: b"};
  write_record(file, record);
  EXPECT_EQ(read_record(file).notes, record.notes);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace gramloom
