#include "runs/record.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "runs/format.h"

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

// Until version 2 the settings alone said of which maps green points where, or nothing but names.
TEST(Record, AnOlderOnesNormalsAreToldByItsSettings) {
  JobRecord record;
  record.settings = {{"exemplar",
                      {{"maps",
                        {{"normal", {{"image", "Bricks_NormalDX.png"}}},
                         {"n", {{"image", "n.png"}, {"kind", "normal"}, {"green", "down"}}},
                         {"relief_normal", {{"image", "r.png"}}},
                         {"height", {{"image", "h_dx.png"}}},
                         {"mine", {{"image", "wall_normal.png"}, {"kind", "colour"}}}}}}},
                     {"surface", {{"normal", true}, {"green", "down"}}}};
  Json json = parse_json(format_to_text(record));
  json["version"] = 2;
  json.erase("normals");
  const auto normals = format_from_json<JobRecord>(json, "seed1.json").normals;
  EXPECT_EQ(normals, (std::map<std::string, GreenAxis>{{"n", GreenAxis::down},
                                                       {"normal", GreenAxis::down},
                                                       {"relief_normal", GreenAxis::up}}));
  for (const Json& settings : {Json(nullptr), Json(3), Json{{"exemplar", 3}},
                               Json{{"exemplar", {{"maps", {{"normal", "a.png"}}}}}}}) {
    json["settings"] = settings;
    EXPECT_LE(format_from_json<JobRecord>(json, "seed1.json").normals.size(), 1u);
  }
  record.normals = {{"normal", GreenAxis::up}};
  EXPECT_EQ(format_from_json<JobRecord>(parse_json(format_to_text(record)), "").normals,
            record.normals)
      << "a new one says it itself";
}

}  // namespace
}  // namespace gramloom
