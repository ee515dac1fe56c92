#include "jobs/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "core/threads.h"
#include "io/image_file.h"
#include "io/json_fields.h"
#include "io/text_file.h"
#include "io/toml_reader.h"
#include "jobs/folder_lock.h"
#include "jobs/overrides.h"
#include "jobs/protected_files.h"
#include "runs/csv_fields.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* simulation_mark = "gramloom:simulation";  // in the metadata of every picture
constexpr double most_bytes = 4e9;                              // of all pictures

void check_range(const toml::table& table, std::string_view key, const std::vector<double>& range) {
  if (range.size() != 2)
    fail(key_region(table, key), "'{}' has {} numbers, allowed are the least and the most", key,
         range.size());
  if (range[0] > range[1])
    fail(key_region(table, key), "'{}' = [{}, {}]: the least comes first", key, range[0], range[1]);
}

std::string picture_name(std::size_t index) { return fmt::format("pose_{:04}.exr", index + 1); }

CsvRow columns() {
  CsvRow columns{"picture"};
  for (const std::string& angle : field_columns<Pose>({})) columns.push_back(angle);
  return columns;
}

std::string table_of(const std::vector<Pose>& poses) {
  std::string text = csv_line(columns());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CsvRow row{picture_name(i)};
    for (const std::string& angle : field_cells<Pose, double>(poses[i], {})) row.push_back(angle);
    text += csv_line(row);
  }
  return text;
}

void check_table(const fs::path& table, const ProtectedFiles& inputs) {
  if (!is_there(table)) return;
  inputs.check(table);
  std::error_code ignored;
  if (!fs::is_regular_file(table, ignored) || !read_text(table).starts_with(csv_line(columns())))
    throw Error("would replace {}, which this command did not make",
                table.lexically_normal().string());
}

void check_folder(const Simulation& simulation, const fs::path& folder) {
  const ProtectedFiles inputs({{simulation.file, "the simulation reads"}});
  check_table(folder / "poses.csv", inputs);
  for (int i = 0; i < simulation.params.poses; ++i)
    check_replaced(folder / picture_name(static_cast<std::size_t>(i)), inputs, simulation_mark);
}

Metadata metadata_of(const Simulation& simulation, const Pose& pose) {
  const Json made_by{{"pose", to_json_value(pose)}, {"sleeve", to_json_value(simulation.sleeve)}};
  return {{simulation_mark, to_text(made_by, -1, true)}};
}

}  // namespace

Simulation parse_simulation(const std::string& text, const fs::path& file) {
  toml::table table = parse_toml(text, file.string());
  const std::string sleeve(ClothParams::name);
  check_keys(table, key_names<SimulationParams>({sleeve}));
  Simulation simulation{file, {}, {}};
  read_fields(simulation.params, table);
  check_range(table, "bend", simulation.params.bend);
  check_range(table, "twist", simulation.params.twist);
  check_range(table, "swing", simulation.params.swing);
  if (const toml::table* cloth = single_section(table, sleeve)) {
    check_keys(*cloth, key_names<ClothParams>());
    read_fields(simulation.sleeve, *cloth);
  }
  return simulation;
}

Simulation read_simulation(const fs::path& file) {
  std::string text;
  try {
    text = read_text(file);
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
  return parse_simulation(text, file);
}

// The additive sequence whose steps are powers of the root of x⁴ = x + 1 (Roberts 2018, "The
// unreasonable effectiveness of quasirandom sequences"), from a random start.
std::vector<Pose> poses_of(const SimulationParams& params) {
  constexpr double step = 0.81917251339616443;
  const std::array<double, 3> steps{step, step * step, step * step * step};
  Random random(static_cast<std::uint64_t>(params.seed));
  std::array<double, 3> place{};
  for (double& p : place) p = static_cast<double>(random.uniform());
  std::vector<Pose> poses(static_cast<std::size_t>(params.poses));
  for (Pose& pose : poses) {
    for (std::size_t k = 0; k < 3; ++k) {
      place[k] += steps[k];
      place[k] -= std::floor(place[k]);
    }
    const auto angle = [](const std::vector<double>& range, double at) {
      const double value = range[0] + (range[1] - range[0]) * at;
      return std::clamp(std::floor(value * 100 + 0.5) / 100, range[0], range[1]);
    };
    pose = {angle(params.bend, place[0]), angle(params.twist, place[1]),
            angle(params.swing, place[2])};
  }
  return poses;
}

std::string pose_table(const Simulation& simulation) {
  return table_of(poses_of(simulation.params));
}

std::vector<PosedSleeve> simulate(const Simulation& simulation, const Control& control) {
  const Size size = simulation.sleeve.size;
  const double bytes = 4.0 * size.width * size.height * simulation.params.poses;
  if (bytes > most_bytes)
    throw ConfigError("{}: {} pictures of {}×{} take {:.1f} GB, allowed are {:.0f}",
                      simulation.file.string(), simulation.params.poses, size.width, size.height,
                      1e-9 * bytes, 1e-9 * most_bytes);
  std::vector<PosedSleeve> made;
  for (const Pose& pose : poses_of(simulation.params)) made.push_back({pose, {}});
  const auto count = static_cast<std::int64_t>(made.size());
  for (std::int64_t first = 0; first < count;) {
    control.step(first, count);
    const std::int64_t some = std::min<std::int64_t>(thread_count(), count - first);
    parallel_for(some, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        PosedSleeve& sleeve = made[static_cast<std::size_t>(first + i)];
        sleeve.displacement = sleeve_displacement(simulation.sleeve, sleeve.pose);
      }
    });
    first += some;
  }
  control.step(count, count);
  return made;
}

Cost estimate_simulation(const Simulation& simulation) {
  constexpr double seconds_per_point = 6.5e-8;  // measured; of an iteration
  const ClothParams& sleeve = simulation.sleeve;
  const double points = 1.0 * simulation.params.poses * sleeve.size.width * sleeve.size.height;
  return {sizeof(float) * points,
          {.shared = points * sleeve.steps * sleeve.iterations * seconds_per_point}};
}

fs::path make_simulation(const Simulation& simulation, const fs::path& folder,
                         const Control& control) {
  try {
    check_folder(simulation, folder);
    create_folder(folder);
  } catch (const Error& error) {
    throw ConfigError("--output {}: {}", folder.string(), error.what());
  }
  const auto lock = lock_folder(folder);
  const std::vector<PosedSleeve> made = simulate(simulation, control);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < made.size(); ++i) {
    write_image(folder / picture_name(i), made[i].displacement, {PixelType::float32, "", {}},
                metadata_of(simulation, made[i].pose));
    poses.push_back(made[i].pose);
  }
  write_text(folder / "poses.csv", table_of(poses));
  return folder / "poses.csv";
}

bool is_simulated(const Simulation& simulation, const fs::path& folder) {
  const std::vector<Pose> poses = poses_of(simulation.params);
  try {
    if (read_text(folder / "poses.csv") != table_of(poses)) return false;
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (read_image(folder / picture_name(i)).metadata != metadata_of(simulation, poses[i]))
        return false;
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace gramloom
