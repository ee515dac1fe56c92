#pragma once

#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "runs/record.h"

namespace gramloom {

/// How unlike the results of one exemplar and method with several seeds are.
struct SeedDiversity {
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

/// Those of `list` that are of the textures that `jobs` have now.
std::vector<SeedDiversity> valid_diversity(const std::vector<SeedDiversity>& list,
                                           const std::vector<NamedRecord>& jobs);

}  // namespace gramloom
