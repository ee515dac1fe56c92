#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "core/map_words.h"
#include "io/json_fields.h"
#include "runs/circumstances.h"
#include "runs/trace_file.h"

namespace gramloom {

/// How a job stands. Only a job that was not begun is waiting, and that has no record on disk.
enum class Status { done, failed, interrupted, waiting };
template <>
inline constexpr auto enum_names<Status> =
    std::to_array<std::string_view>({"done", "failed", "interrupted", "waiting"});

/// How an iterative method's loss went.
struct LossSummary {
  std::int64_t iterations = 0;
  std::int64_t evaluations = 0;
  double first = 0;
  double last = 0;

  static constexpr auto fields() {
    using L = LossSummary;
    return std::tuple{
        Field{"iterations", &L::iterations, "steps done", "", {0, 9e15}},
        Field{"evaluations", &L::evaluations, "of the loss", "", {0, 9e15}},
        Field{"first", &L::first, "loss of the first step"},
        Field{"last", &L::last, "loss of the last step"},
    };
  }
};
std::optional<LossSummary> summarise(const Trace& trace);

/// The network that a job looked at, as it was then: its hash stands in the settings.
struct NetworkUsed {
  std::string file;  // that the config's word stood for
  std::string text;  // its description

  static constexpr auto fields() {
    using N = NetworkUsed;
    return std::tuple{
        Field{"file", &N::file, "where its description was"},
        Field{"text", &N::text, "its description"},
    };
  }
};

/// What a job left behind and what that depended on: the content of its JSON file, which is written
/// last and so marks that the job's other files are complete.
struct JobRecord {
  static constexpr int version = 3;
  static constexpr std::string_view what = "the record of a job";

  std::string exemplar;  // the folder's name
  std::string method;
  std::string kind;
  int seed = 0;
  Size size;
  Status status = Status::interrupted;
  std::string error;
  double seconds = 0;  // over all attempts
  double peak_memory_mb = 0;
  Json settings;  // everything that the result depends on; files by the content that was read
  std::optional<NetworkUsed> network;
  Machine machine;  // of the last attempt
  Named<std::string> versions;
  std::string config;       // its path as the command line had it
  std::string config_hash;  // of its text
  std::vector<std::string> set;
  using Values = std::map<std::string, std::optional<double>>;
  Values metrics;                                            // none: undefined; empty: not scored
  std::optional<std::map<std::string, Values>> map_metrics;  // of the exemplar's maps, by name
  std::optional<LossSummary> loss;
  std::vector<std::string> files;  // pictures, beside the JSON file; the texture is the first
  std::map<std::string, GreenAxis> normals;  // maps of normals by name: where their green points
  std::string texture;                       // the hash of the first one's content
  std::string copy_map;  // picture of where pixels came from, relative to the run's folder; or ""
  std::vector<std::string> notes;  // where values of files were changed on the way: one line each
  double score_seconds = 0;        // apart from `seconds`
  std::string score_error;  // why a finished texture has no scores; "" where nothing went wrong

  static constexpr auto fields() {
    using R = JobRecord;
    constexpr Range from_0{0, std::numeric_limits<double>::max()};
    return std::tuple{
        Field{"exemplar", &R::exemplar, "the folder's name"},
        Field{"method", &R::method, "its name in the config"},
        Field{"kind", &R::kind, "of the method"},
        Field{"seed", &R::seed, "of the random numbers", "", {0, 2147483647}},
        Field{"size", &R::size, "width and height of the texture", "pixels", {0, longest_side}},
        Field{"status", &R::status, "how the job stands"},
        Field{"error", &R::error, "why it is not done"},
        Field{"seconds", &R::seconds, "time that the method took, over all attempts", "s", from_0},
        Field{"peak_memory_mb", &R::peak_memory_mb, "of the process while it worked", "MB", from_0},
        Field{"settings", &R::settings, "everything that the result depends on"},
        Field{"network", &R::network, "the network's description"},
        Field{"machine", &R::machine, "where it ran last"},
        Field{"versions", &R::versions, "of the program and its libraries"},
        Field{"config", &R::config, "path of the config"},
        Field{"config_hash", &R::config_hash, "of the config's text"},
        Field{"set", &R::set, "the values of --set"},
        Field{"metrics", &R::metrics, "scores by their names"},
        Field{"map_metrics", &R::map_metrics, "scores of maps, by the maps' names and theirs"},
        Field{"loss", &R::loss, "of an iterative method"},
        Field{"files", &R::files, "the texture and its maps"},
        Field{"normals", &R::normals, "where the green of normals points, by the maps' names"},
        Field{"texture", &R::texture, "hash of the texture's file"},
        Field{"copy_map", &R::copy_map, "picture of where pixels came from"},
        Field{"notes", &R::notes, "where values of files were changed on the way"},
        Field{"score_seconds", &R::score_seconds, "time that scoring took", "s", from_0},
        Field{"score_error", &R::score_error, "why there are no scores"},
    };
  }

  /// Version 1 had the size in two keys and the loss in four; up to version 2 the settings alone
  /// said where green points. Throws Error.
  static void upgrade(Json& json, const std::string& file);
};

/// A job's name, "pebbles/quilting/seed1", and its record.
struct NamedRecord {
  std::string name;
  JobRecord record;
};

/// Writes the record; throws Error.
void write_record(const std::filesystem::path& file, const JobRecord& record);
/// Throws Error, one line with file and key, when it is missing, damaged or of something else.
JobRecord read_record(const std::filesystem::path& file);
/// None when there is no such file, or nothing that read_record() reads.
std::optional<JobRecord> find_record(const std::filesystem::path& file);

/// Whether `record` is of a finished job whose pictures are still in `folder`.
bool is_finished(const std::optional<JobRecord>& record, const std::filesystem::path& folder);

}  // namespace gramloom
