// The JSON files of a run: what every format does, driven by the field lists.
#include "runs/format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temp_folder.h"
#include "runs/comparison.h"
#include "runs/filled.h"
#include "runs/run_record.h"

namespace gramloom {
namespace {

using testing::HasSubstr;

template <class T>
class EveryFormat : public testing::Test {
 protected:
  EveryFormat() {
    int count = 0;
    value_ = filled<T>(count);
    json_ = parse_json(format_to_text(value_));
  }
  // What is wrong with this text; "" when it can be read.
  static std::string error(const Json& json) {
    try {
      format_from_json<T>(json, "the file");
    } catch (const Error& thrown) {
      EXPECT_EQ(std::string(thrown.what()).find('\n'), std::string::npos) << thrown.what();
      return thrown.what();
    }
    return "";
  }

  T value_;
  Json json_;
};
using Formats = testing::Types<JobRecord, RunRecord, ComparisonRecord>;
TYPED_TEST_SUITE(EveryFormat, Formats);

TYPED_TEST(EveryFormat, ComesBackAsItWas) {
  const auto back = format_from_json<TypeParam>(this->json_, "the file");
  EXPECT_EQ(format_to_text(back), format_to_text(this->value_));
  EXPECT_EQ(this->json_["version"], TypeParam::version);
  const Json defaults = to_json_value(TypeParam{});
  for (const auto& [key, value] : defaults.items()) EXPECT_NE(this->json_[key], value) << key;
}

TYPED_TEST(EveryFormat, AWrongTypeIsOneLineWithFileAndKey) {
  for_each_field<TypeParam>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::value_type;
    if constexpr (!std::is_same_v<Value, Json>) {
      const std::string key(field.name);
      Json wrong = this->json_;
      wrong[key] = true;
      EXPECT_THAT(this->error(wrong), HasSubstr(fmt::format("the file: '{}' is true", key)));
      wrong.erase(key);
      EXPECT_EQ(this->error(wrong),
                is_optional<Value> ? "" : fmt::format("the file: '{}' is missing", key));
    }
  });
  for (const Json& other : {Json(), Json::array(), Json("text"), Json(3)})
    EXPECT_THAT(this->error(other), HasSubstr("the file: is not "));
  Json version = this->json_;
  version["version"] = "two";
  EXPECT_THAT(this->error(version), HasSubstr("the file: 'version'"));
}

TYPED_TEST(EveryFormat, WhatANewerProgramAddsIsSkipped) {
  Json newer = this->json_;
  newer["version"] = TypeParam::version + 1;
  newer["unheard_of"] = {1, 2, 3};
  EXPECT_EQ(this->error(newer), "");
  EXPECT_EQ(format_to_text(format_from_json<TypeParam>(newer, "")), format_to_text(this->value_));
  newer.erase(std::string(std::get<0>(TypeParam::fields()).name));
  EXPECT_THAT(this->error(newer),
              HasSubstr(fmt::format("a newer gramloom wrote it: version {}, this one knows {}",
                                    TypeParam::version + 1, TypeParam::version)));
}

TYPED_TEST(EveryFormat, TheBytesOfAPathThatAreNoUtf8AreReplaced) {
  TypeParam value = this->value_;
  for_each_field<TypeParam>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::value_type;
    if constexpr (std::is_same_v<Value, std::string>) value.*field.member = "caf\xE9";
  });
  EXPECT_EQ(this->error(parse_json(format_to_text(value))), "");
}

class FormatFile : public TempFolder {};

TEST_F(FormatFile, CutOffAnywhereItIsOneLineWithItsName) {
  int count = 0;
  const std::string text = format_to_text(filled<JobRecord>(count));
  const auto file = path() / "seed1.json";
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    write_text(file, text.substr(0, length));
    try {
      read_record(file);
      FAIL() << "read with " << length << " bytes";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(file.string()));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
    EXPECT_FALSE(find_record(file));
  }
  write_text(file, std::string(200000, '['));
  EXPECT_THROW(read_record(file), Error);
}

TEST(JobRecord, OfVersion1IsRead) {
  const Json old = parse_json(R"({
    "exemplar": "pebbles", "method": "gram", "kind": "neural", "seed": 7, "width": 64, "height": 48,
    "status": "done", "error": "", "seconds": 1.5, "peak_memory_mb": 237.9,
    "settings": {"method": {"kind": "neural"}, "seed": 7}, "metrics": {"stsim2": 0.9, "seam_x": null},
    "files": ["seed7.png"], "score_seconds": 0.06,
    "iterations": 10, "evaluations": 12, "loss_first": 0.5, "loss_last": 0.25})");
  const auto record = format_from_json<JobRecord>(old, "f");
  EXPECT_EQ(record.seed, 7);
  EXPECT_EQ(record.size, (Size{64, 48}));
  EXPECT_EQ(record.status, Status::done);
  EXPECT_EQ(record.metrics.at("stsim2"), 0.9);
  EXPECT_EQ(record.metrics.at("seam_x"), std::nullopt);
  ASSERT_TRUE(record.loss);
  EXPECT_EQ(record.loss->evaluations, 12);
  EXPECT_EQ(record.loss->last, 0.25);
  EXPECT_EQ(record.machine.threads, 0) << "not known";
  EXPECT_THROW(format_from_json<JobRecord>({{"status", "done"}}, "f"), Error);
  Json wrong = old;
  wrong["width"] = "wide";
  EXPECT_THROW(format_from_json<JobRecord>(wrong, "f"), Error);
}

TEST(RunRecord, OfVersion1IsReadAndNamesAJobsKey) {
  const Json old = parse_json(R"({"date": "2026-11-22T13:25:04Z", "command": ["gramloom"],
    "versions": {"gramloom": "0.1.0", "fmt": "9.1.0"},
    "machine": {"processor": "P", "cores": 2, "threads": 2, "memory": "3 kB"},
    "config": "c.toml", "config_text": "", "set": [], "settings": {},
    "jobs": {"e/q/seed2": {"status": "done", "seconds": 3}, "e/q/seed10": {"status": "waiting"}},
    "diversity": [{"exemplar": "e", "method": "q", "seeds": [1, 2], "value": 0.5}]})");
  const auto run = format_from_json<RunRecord>(old, "run.json");
  ASSERT_EQ(run.jobs.size(), 2u);
  EXPECT_EQ(run.jobs[0].first, "e/q/seed2") << "in the order of the plan";
  EXPECT_EQ(run.jobs[1].second.status, Status::waiting);
  EXPECT_EQ(run.versions[0].second, "0.1.0");
  EXPECT_EQ(run.diversity[0].seeds, (std::vector<int>{1, 2}));
  Json wrong = old;
  wrong["jobs"]["e/q/seed2"]["status"] = "doen";
  try {
    format_from_json<RunRecord>(wrong, "run.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "run.json: 'jobs/e/q/seed2/status' is \"doen\", allowed is one of done, failed, "
                 "interrupted, waiting");
  }
}

}  // namespace
}  // namespace gramloom
