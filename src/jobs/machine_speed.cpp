#include "jobs/machine_speed.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "core/machine_speed.h"
#include "io/json_fields.h"
#include "io/text_file.h"
#include "jobs/machine.h"
#include "neural/blas_speed.h"

namespace gramloom {

namespace fs = std::filesystem;

namespace {

// The file in the cache folder.
struct SpeedRecord {
  std::string version;
  Machine machine;
  double serial = 0, shared = 0, operations = 0;  // operations 0: not measured yet

  static constexpr auto fields() {
    using S = SpeedRecord;
    return std::tuple{
        Field{"version", &S::version, "of the program that measured"},
        Field{"machine", &S::machine, "that was measured"},
        Field{"serial", &S::serial, "speed of one thread", "", {0, 1e9}},
        Field{"shared", &S::shared, "speed of all threads", "", {0, 1e9}},
        Field{"operations", &S::operations, "of matrix products a second", "", {0, 1e300}},
    };
  }
};

// Empty where there is no such folder.
fs::path cache_file() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return fs::path(cache) / "gramloom/speed.json";
  const char* home = std::getenv("HOME");
  return home && *home == '/' ? fs::path(home) / ".cache/gramloom/speed.json" : fs::path();
}

// Nothing for a file that is not there, or that is of no use: it is only a cache.
std::optional<SpeedRecord> kept_speed(const fs::path& file) {
  try {
    SpeedRecord record = from_json_value<SpeedRecord>(read_json(file), JsonPlace{file.string()});
    if (record.version == version() && record.machine == machine() && record.serial > 0 &&
        record.shared > 0)
      return record;
  } catch (const Error&) {
  }
  return std::nullopt;
}

void keep_speed(const fs::path& file, const SpeedRecord& record) {
  if (file.empty()) return;
  try {
    fs::create_directories(file.parent_path());
    write_text(file, to_text(to_json_value(record), 2) + "\n");
  } catch (const std::exception&) {
    // Measured again the next time.
  }
}

bool is_old(const fs::path& file) {
  std::error_code none;
  const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file, none);
  // One of tomorrow was written before someone set the clock back.
  return none || age > std::chrono::hours(24) || age < age.zero();
}

void measure(SpeedRecord& record) {
  const Speed speed = measure_speed();
  record.serial = std::max(record.serial, speed.serial);
  record.shared = std::max(record.shared, speed.shared);
}

// 0 where the neural part is not installed.
double measure_operations() {
  try {
    return operations_per_second();
  } catch (const Error&) {
    return 0;
  }
}

}  // namespace

Speed machine_speed(bool with_operations) {
  const fs::path file = cache_file();
  const std::optional<SpeedRecord> kept = kept_speed(file);
  SpeedRecord record = kept.value_or(SpeedRecord{std::string(version()), machine()});
  const bool anew = !kept || is_old(file);
  if (anew) measure(record);
  if (with_operations && (anew || record.operations <= 0))
    record.operations = std::max(record.operations, measure_operations());
  if (anew || !kept || record.operations != kept->operations) keep_speed(file, record);
  const double as_all_else = Speed{}.operations * record.shared / Speed{}.shared;
  return {record.serial, record.shared, record.operations > 0 ? record.operations : as_all_else};
}

}  // namespace gramloom
