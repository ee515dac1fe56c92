#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/cost.h"
#include "core/progress.h"
#include "surface/cloth.h"

namespace gramloom {

/// Which poses of a sleeve are simulated: the top of the config of `gramloom simulate`.
struct SimulationParams {
  static constexpr std::string_view name = "simulation";
  static constexpr std::string_view summary = "pictures of a sleeve in many poses";

  int poses = 240;
  int seed = 1;
  std::vector<double> bend{0, 110};
  std::vector<double> twist{-60, 60};
  std::vector<double> swing{-60, 60};

  friend bool operator==(const SimulationParams&, const SimulationParams&) = default;

  static constexpr auto fields() {
    using S = SimulationParams;
    return std::tuple{
        Field{"poses", &S::poses, "how many", "", {1, 100000}},
        Field{"seed", &S::seed, "of the poses", "", {0, 2147483647}},
        Field{"bend", &S::bend, "least and most bend of the elbow", "degrees", bend_range},
        Field{"twist", &S::twist, "likewise twist of the forearm", "degrees", turn_range},
        Field{"swing", &S::swing, "likewise of the upper arm", "degrees", turn_range},
    };
  }
};

/// A config of `gramloom simulate`.
struct Simulation {
  std::filesystem::path file;
  SimulationParams params;
  ClothParams sleeve;  // its [sleeve]
};

/// Reads such a config. Throws ConfigError, which says where the mistake is.
Simulation read_simulation(const std::filesystem::path& file);
/// The same for a text; `file` is what errors call it.
Simulation parse_simulation(const std::string& text, const std::filesystem::path& file);

/// Its poses, spread evenly over the ranges: the first of them are so too. In hundredths of a
/// degree, as a table holds them.
std::vector<Pose> poses_of(const SimulationParams& params);

/// Their table, as make_simulation() leaves it.
std::string pose_table(const Simulation& simulation);

/// A pose and how far its sleeve lies outside the arm's tube: see sleeve_displacement().
struct PosedSleeve {
  Pose pose;
  Image displacement;
};

/// All poses of a simulation, in their order: the same bytes for any threads and machine. Throws
/// ConfigError where they do not fit into memory, Interrupted when `control` says stop.
std::vector<PosedSleeve> simulate(const Simulation& simulation, const Control& control);

/// What simulate() is expected to need.
Cost estimate_simulation(const Simulation& simulation);

/// Simulates and leaves in the folder a picture of each pose, pose_0001.exr …, and poses.csv, whose
/// rows are "picture,bend,twist,swing"; returns the latter. Pictures hold floats, so that radii
/// stay radii. Throws as simulate() does, and ConfigError where another file would be replaced than
/// one of an earlier simulation, or the folder cannot be made; nothing is written then.
std::filesystem::path make_simulation(const Simulation& simulation,
                                      const std::filesystem::path& folder, const Control& control);

/// Whether the folder holds all that: the table, and every picture as this simulation makes it.
bool is_simulated(const Simulation& simulation, const std::filesystem::path& folder);

}  // namespace gramloom
