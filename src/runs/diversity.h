#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "runs/record.h"

namespace gramloom {

/// How unlike the results of one exemplar and method with several seeds are: the content of their
/// diversity.json.
struct SeedDiversity {
  static constexpr int version = 1;
  static constexpr std::string_view what = "the diversity of a method's seeds";
  std::string exemplar;
  std::string method;
  std::vector<int> seeds;
  double value = 0;
  std::string textures;  // which ones, by their content: see textures_of()

  friend bool operator==(const SeedDiversity&, const SeedDiversity&) = default;

  static constexpr auto fields() {
    using D = SeedDiversity;
    return std::tuple{
        Field{"exemplar", &D::exemplar, "the folder's name"},
        Field{"method", &D::method, "its name in the config"},
        Field{"seeds", &D::seeds, "of the textures", "", {0, 2147483647}},
        Field{"value", &D::value, "the diversity"},
        Field{"textures", &D::textures, "hash of the textures' content"},
    };
  }
};

/// The finished jobs of one exemplar and method as a diversity that is still to be computed: their
/// seeds, and a hash of the textures' hashes ("" where records of an older version lack one).
SeedDiversity diversity_of_records(const std::string& exemplar, const std::string& method,
                                   const std::vector<NamedRecord>& jobs);

/// Those that the folder `output` has of the exemplars and methods of `jobs`, and in their place,
/// where there are none, those of `earlier`. A file that cannot be read has none.
std::vector<SeedDiversity> find_diversity(const std::filesystem::path& output,
                                          const std::vector<NamedRecord>& jobs,
                                          const std::vector<SeedDiversity>& earlier);

/// Those of `list` that are of the textures that `jobs` have now.
std::vector<SeedDiversity> valid_diversity(const std::vector<SeedDiversity>& list,
                                           const std::vector<NamedRecord>& jobs);

}  // namespace gramloom
