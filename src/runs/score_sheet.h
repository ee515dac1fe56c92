#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/diversity.h"
#include "runs/record.h"

namespace gramloom {

/// A job in scores.csv; what is not known has an empty cell.
struct ScoreRow {
  std::string exemplar;
  std::string method;
  std::string kind;
  int seed = 0;
  Status status = Status::waiting;
  std::optional<double> seconds;
  std::optional<double> peak_memory_mb;
  std::vector<std::optional<double>> scores;

  friend bool operator==(const ScoreRow&, const ScoreRow&) = default;

  static constexpr auto fields() {
    using S = ScoreRow;
    return std::tuple{
        Field{"exemplar", &S::exemplar, "the folder's name"},
        Field{"method", &S::method, "its name in the config"},
        Field{"kind", &S::kind, "of the method"},
        Field{"seed", &S::seed, "of the random numbers"},
        Field{"status", &S::status, "how the job stands"},
        Field{"seconds", &S::seconds, "time that the method took", "s"},
        Field{"peak_memory_mb", &S::peak_memory_mb, "of the process", "MB"},
    };
  }
};

/// The table scores.csv: a line for each job.
struct ScoreSheet {
  std::vector<std::string> metrics;  // the columns after a row's fields
  std::vector<ScoreRow> rows;

  friend bool operator==(const ScoreSheet&, const ScoreSheet&) = default;
};

/// `metrics`: the names of the scores. The one called "diversity" is in `diversity`.
ScoreSheet score_sheet(const std::vector<NamedRecord>& jobs,
                       const std::vector<SeedDiversity>& diversity,
                       const std::vector<std::string>& metrics);

/// A table (csv.h). Numbers and names come back as they were.
std::string to_csv(const ScoreSheet& sheet);
/// The reverse. Throws Error for a line that is none of such a table.
ScoreSheet parse_score_sheet(const std::string& csv);

}  // namespace gramloom
