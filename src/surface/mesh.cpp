#include "surface/mesh.h"

#include <numeric>
#include <unordered_map>

#include "core/error.h"

namespace gramloom {

namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Vec3 area_vector(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3& a = mesh.positions[t[0]];
  return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a) * 0.5f;
}

// In a file's own unit of length, whose squares may be beyond floats.
bool has_area(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const auto edge = [&](std::size_t corner) {
    const Vec3 &from = mesh.positions[t[0]], &to = mesh.positions[t[corner]];
    return std::array{static_cast<double>(to.x) - static_cast<double>(from.x),
                      static_cast<double>(to.y) - static_cast<double>(from.y),
                      static_cast<double>(to.z) - static_cast<double>(from.z)};
  };
  const auto a = edge(1), b = edge(2);
  return a[1] * b[2] != a[2] * b[1] || a[2] * b[0] != a[0] * b[2] || a[0] * b[1] != a[1] * b[0];
}

// The angle of a triangle at one of its corners.
float angle_at(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, std::size_t corner) {
  const Vec3& here = mesh.positions[t[corner]];
  const Vec3 a = mesh.positions[t[(corner + 1) % 3]] - here;
  const Vec3 b = mesh.positions[t[(corner + 2) % 3]] - here;
  return std::atan2(length(cross(a, b)), dot(a, b));
}

std::uint64_t cell_key(float x, float y, float z) {
  const auto bits = [](float v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(v)) & ((1 << 21) - 1);
  };
  return bits(x) << 42 | bits(y) << 21 | bits(z);
}

// Whether the triangles around a vertex do not close to a ring. In a ring each neighbour is once
// the next and once the last one of a triangle's two, so that the sums of both are equal. A vertex
// of no triangle is in no ring.
std::vector<bool> border_vertices(const Mesh& mesh) {
  std::vector<std::uint64_t> sums(mesh.positions.size());
  const auto mixed = [](std::uint64_t i) { return (i + 1) * 0x9E3779B97F4A7C15u; };
  std::vector<bool> used(sums.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      used[t[corner]] = true;
      sums[t[corner]] += mixed(t[(corner + 1) % 3]) - mixed(t[(corner + 2) % 3]);
    }
  std::vector<bool> border(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) border[i] = sums[i] != 0 || !used[i];
  return border;
}

}  // namespace

void check_mesh(const Mesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) throw Error("{}: a mesh of 0 faces, it needs 1 at least", name);
  if (mesh.triangles.size() > most_triangles)
    throw Error("{}: a mesh of {} triangles, allowed are {}", name, mesh.triangles.size(),
                most_triangles);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!is_finite(mesh.positions[i]) || !is_finite(mesh.normals[i]) ||
        (!mesh.coordinates.empty() &&
         !(std::isfinite(mesh.coordinates[i].u) && std::isfinite(mesh.coordinates[i].v))))
      throw Error("{}: vertex {} has a value that is not a finite number", name, i + 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (!has_area(mesh, mesh.triangles[i]))
      throw Error("{}: triangle {} has no area: its corners must not lie on one line", name, i + 1);
}

std::vector<std::uint32_t> same_places(const Mesh& mesh, float distance) {
  // A cell is larger than the distance: what is near lies in it or in a neighbour.
  const float cell = 4 * distance;
  const std::vector<bool> border = border_vertices(mesh);
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells;
  std::vector<std::uint32_t> first(mesh.positions.size());
  std::iota(first.begin(), first.end(), 0u);
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (!border[i]) continue;
    const Vec3& here = mesh.positions[i];
    const Vec3 q = here / cell;
    const auto key = [&](int corner, float reach) {
      const auto step = [&](int bit) { return corner & bit ? reach : -reach; };
      return cell_key(std::floor(q.x + step(1)), std::floor(q.y + step(2)),
                      std::floor(q.z + step(4)));
    };
    for (int corner = 0; corner < 8 && first[i] == i; ++corner) {
      const auto [begin, end] = cells.equal_range(key(corner, 0.25f));
      for (auto it = begin; it != end; ++it)
        if (length(mesh.positions[it->second] - here) <= distance)
          first[i] = std::min(first[i], it->second);
    }
    if (first[i] == i) cells.emplace(key(0, 0), i);
  }
  return first;
}

std::vector<Vec3> smooth_normals(const Mesh& mesh, NormalWeights weights) {
  const std::vector<std::uint32_t> place = same_places(mesh);
  std::vector<Vec3> sums(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 area = area_vector(mesh, t);
    for (std::size_t corner = 0; corner < 3; ++corner)
      sums[place[t[corner]]] +=
          weights == NormalWeights::area ? area : normalised(area) * angle_at(mesh, t, corner);
  }
  std::vector<Vec3> normals(mesh.positions.size());
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = normalised(sums[place[i]]);
  return normals;
}

Mesh faceted(const Mesh& mesh) {
  Mesh result;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    const Vec3 normal = normalised(area_vector(mesh, t));
    for (const std::uint32_t corner : t) {
      result.positions.push_back(mesh.positions[corner]);
      result.normals.push_back(normal);
      if (!mesh.coordinates.empty()) result.coordinates.push_back(mesh.coordinates[corner]);
    }
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

Mesh fitted(Mesh mesh) {
  if (mesh.positions.empty()) return mesh;
  Vec3 low = mesh.positions.front(), high = low;
  for (const Vec3& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 middle = low * 0.5f + high * 0.5f, half = high * 0.5f - low * 0.5f;
  // Squares of very large and of very small numbers are no floats.
  const float extent = std::max({half.x, half.y, half.z});
  const bool extreme = extent > 1e15f || (extent > 0 && extent < 1e-15f);
  float radius = 0;
  for (Vec3& p : mesh.positions) {
    p = (p - middle) / (extreme ? extent : 1.0f);
    radius = std::max(radius, length(p));
  }
  if (radius > 0)
    for (Vec3& p : mesh.positions) p = p / radius;
  return mesh;
}

namespace {

// The corners half-way along edges that are too long, each made once.
class Halves {
 public:
  explicit Halves(Mesh& mesh, float longest) : mesh_(mesh), longest_(longest) {}

  /// The new corner, or none (0 is never new).
  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    if (length(mesh_.positions[a] - mesh_.positions[b]) <= longest_) return 0;
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [at, added] = made_.try_emplace(key, mesh_.positions.size());
    if (added) {
      mesh_.positions.push_back((mesh_.positions[a] + mesh_.positions[b]) * 0.5f);
      mesh_.normals.push_back(normalised(mesh_.normals[a] + mesh_.normals[b]));
      if (!mesh_.coordinates.empty())
        mesh_.coordinates.push_back((mesh_.coordinates[a] + mesh_.coordinates[b]) * 0.5f);
    }
    return at->second;
  }

 private:
  Mesh& mesh_;
  float longest_;
  std::unordered_map<std::uint64_t, std::uint32_t> made_;
};

// A triangle in up to four, by the new corners on its edges ab, bc and ca. Whether an edge is
// halved depends on the edge alone, so that both its triangles agree and no crack opens.
void split(std::array<std::uint32_t, 3> t, std::array<std::uint32_t, 3> half,
           std::vector<std::array<std::uint32_t, 3>>& into) {
  const int count = (half[0] != 0) + (half[1] != 0) + (half[2] != 0);
  // Turned so that the one new corner is on ab, or the one edge without is ca.
  while ((count == 1 && half[0] == 0) || (count == 2 && half[2] != 0)) {
    t = {t[1], t[2], t[0]};
    half = {half[1], half[2], half[0]};
  }
  const auto [a, b, c] = t;
  const auto [ab, bc, ca] = half;
  if (count == 0) {
    into.push_back(t);
  } else if (count == 1) {
    into.push_back({a, ab, c});
    into.push_back({ab, b, c});
  } else if (count == 2) {
    into.push_back({a, ab, c});
    into.push_back({ab, bc, c});
    into.push_back({ab, b, bc});
  } else {
    into.push_back({a, ab, ca});
    into.push_back({ab, b, bc});
    into.push_back({ca, bc, c});
    into.push_back({ab, bc, ca});
  }
}

}  // namespace

Mesh subdivided(Mesh mesh, float longest) {
  for (std::size_t before = 0; before != mesh.triangles.size();) {
    before = mesh.triangles.size();
    Halves halves(mesh, longest);
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& t : mesh.triangles)
      split(t, {halves.of(t[0], t[1]), halves.of(t[1], t[2]), halves.of(t[2], t[0])}, finer);
    if (finer.size() > most_triangles)
      throw Error("a mesh of {} triangles would be displaced, allowed are {}: choose larger detail",
                  finer.size(), most_triangles);
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

}  // namespace gramloom
