#include "neural/flow/first_fill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/threads.h"
#include "neural/flow/guided_patches.h"
#include "neural/loss/directed_places.h"

namespace gramloom::neural {

namespace {

constexpr std::size_t most_looked_at = 16384;
constexpr std::int64_t places_at_once = 256;

// A pixel of a patch that counts, relative to its first one.
struct Part {
  int dx, dy;  // in the patch
  int x, y;    // in the picture
  bool known;  // else it is to be filled
};

class Filling {
 public:
  Filling(const Guidance& guidance, Image picture, const Image& exemplar, int side)
      : guidance_(guidance),
        picture_(std::move(picture)),
        exemplar_(exemplar),
        side_(side),
        confidence_(picture_.size(), 1),
        priority_(picture_.size(), 1, -1.0f) {
    for (std::size_t i = 0; i < confidence_.pixels.size(); ++i)
      confidence_.pixels[i] = guidance.made.pixels[i] == 0 ? 1.0f : 0.0f;
    open_ = guidance.made;
    for (const auto& of_exemplar : usable_places(guidance, exemplar.size(), side))
      places_.insert(places_.end(), of_exemplar.begin(), of_exemplar.end());
    places_ = some_of(places_, most_looked_at, Random(1));
    if (guidance.guides())
      guide_scale_ = static_cast<float>(mean_square_of(exemplar, guidance.usable)) *
                     static_cast<float>(exemplar.channels);
    look_around(0, 0, picture_.width, picture_.height);
  }

  Image done() {
    while (const auto next = first_in_turn()) lay(*next);
    return std::move(picture_);
  }

 private:
  struct Pixel {
    int x, y;
  };

  // The pixel there, across edges that wrap; nothing beyond others.
  std::optional<Pixel> pixel(int x, int y) const {
    const int width = picture_.width, height = picture_.height;
    if (tiles_x(guidance_.tile)) x = (x % width + width) % width;
    if (tiles_y(guidance_.tile)) y = (y % height + height) % height;
    if (x < 0 || y < 0 || x >= width || y >= height) return std::nullopt;
    return Pixel{x, y};
  }

  bool is_open(int x, int y) const { return *open_.at(x, y) > 0; }

  std::vector<Part> parts_about(int x, int y) const {
    std::vector<Part> parts;
    for (int dy = 0; dy < side_; ++dy)
      for (int dx = 0; dx < side_; ++dx)
        if (const auto p = pixel(x + dx - side_ / 2, y + dy - side_ / 2))
          parts.push_back({dx, dy, p->x, p->y, !is_open(p->x, p->y)});
    return parts;
  }

  // Mean of the channels, and of the pixel itself where there is nothing known.
  float grey(int x, int y, float otherwise) const {
    const auto p = pixel(x, y);
    if (!p || is_open(p->x, p->y)) return otherwise;
    float sum = 0;
    for (int c = 0; c < picture_.channels; ++c) sum += picture_.at(p->x, p->y)[c];
    return sum / static_cast<float>(picture_.channels);
  }

  float openness(int x, int y) const {
    const auto p = pixel(x, y);
    return p && is_open(p->x, p->y) ? 1.0f : 0.0f;
  }

  // How strongly lines run into the edge there: the largest product of the edge's normal with the
  // gradient, turned a quarter, of known pixels beside it.
  float strength(int x, int y) const {
    const float nx = openness(x + 1, y) - openness(x - 1, y);
    const float ny = openness(x, y + 1) - openness(x, y - 1);
    float strongest = 0;
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) {
        const float own = grey(u, v, std::numeric_limits<float>::max());
        if (own == std::numeric_limits<float>::max()) continue;
        const float gx = grey(u + 1, v, own) - grey(u - 1, v, own);
        const float gy = grey(u, v + 1, own) - grey(u, v - 1, own);
        strongest = std::max(strongest, std::abs(-gy * nx + gx * ny));
      }
    return strongest;
  }

  // The priorities of the pixels there: −1 of those that are not at an edge.
  void look_around(int left, int top, int width, int height) {
    for (int v = top; v < top + height; ++v)
      for (int u = left; u < left + width; ++u) {
        const auto p = pixel(u, v);
        if (!p) continue;
        float& priority = *priority_.at(p->x, p->y);
        priority = -1;
        if (!is_open(p->x, p->y)) continue;
        bool at_edge = false;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          if (const auto beside = pixel(u + dx, v + dy)) at_edge |= !is_open(beside->x, beside->y);
        if (!at_edge) continue;
        float sum = 0, count = 0;
        for (const Part& part : parts_about(p->x, p->y)) {
          if (part.known) sum += *confidence_.at(part.x, part.y);
          ++count;
        }
        priority = sum / count * (strength(p->x, p->y) + 0.05f);
      }
  }

  // The pixel whose patch is laid next; nothing once all are filled.
  std::optional<Pixel> first_in_turn() const {
    const auto best = std::ranges::max_element(priority_.pixels);
    if (*best < 0) return std::nullopt;
    const auto i = static_cast<int>(best - priority_.pixels.begin());
    return Pixel{i % picture_.width, i / picture_.width};
  }

  // Of the patch at that place, from a patch of the picture; more than `least`: any number that is.
  float distance(const std::vector<Part>& parts, PatchPlace from, float least) const {
    float sum = 0;
    for (const Part& part : parts) {
      const float* own = exemplar_.at(from.x + part.dx, from.y + part.dy);
      const float* there = picture_.at(part.x, part.y);
      if (part.known)
        for (int c = 0; c < exemplar_.channels; ++c)
          sum += (own[c] - there[c]) * (own[c] - there[c]);
      if (guide_scale_ > 0) sum += guide_distance(part, from);
      if (sum > least) break;
    }
    return sum;
  }

  float guide_distance(const Part& part, PatchPlace from) const {
    const float* own = guidance_.exemplar_guide.at(from.x + part.dx, from.y + part.dy);
    const float* there = guidance_.guide.at(part.x, part.y);
    const float weight = *guidance_.guide_weight.at(part.x, part.y);
    float sum = 0;
    for (int c = 0; c < guidance_.guide.channels; ++c)
      sum += (own[c] - there[c]) * (own[c] - there[c]);
    return sum * weight * weight * guide_scale_;
  }

  PatchPlace nearest(const std::vector<Part>& parts) const {
    struct Found {
      float distance = std::numeric_limits<float>::max();
      std::size_t place = 0;
    };
    const std::int64_t count = std::ssize(places_);
    std::vector<Found> found(
        static_cast<std::size_t>((count + places_at_once - 1) / places_at_once));
    parallel_for(count, places_at_once, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        Found& best = found[static_cast<std::size_t>(i / places_at_once)];
        const float d = distance(parts, places_[static_cast<std::size_t>(i)], best.distance);
        if (d < best.distance) best = {d, static_cast<std::size_t>(i)};
      }
    });
    return places_[std::ranges::min_element(found, {}, &Found::distance)->place];
  }

  void lay(Pixel at) {
    const std::vector<Part> parts = parts_about(at.x, at.y);
    const PatchPlace from = nearest(parts);
    float sum = 0;
    for (const Part& part : parts)
      if (part.known) sum += *confidence_.at(part.x, part.y);
    const float confidence = sum / static_cast<float>(parts.size());
    for (const Part& part : parts) {
      if (part.known) continue;
      std::copy_n(exemplar_.at(from.x + part.dx, from.y + part.dy), picture_.channels,
                  picture_.at(part.x, part.y));
      *open_.at(part.x, part.y) = 0;
      *confidence_.at(part.x, part.y) = confidence;
    }
    look_around(at.x - side_, at.y - side_, 2 * side_ + 1, 2 * side_ + 1);
  }

  const Guidance& guidance_;
  Image picture_;
  const Image& exemplar_;
  int side_;
  Image open_;  // 1 until it is filled
  Image confidence_, priority_;
  std::vector<PatchPlace> places_;
  float guide_scale_ = 0;
};

}  // namespace

Image first_fill(const Guidance& guidance, Image picture, const Image& exemplar, int side) {
  return Filling(guidance, std::move(picture), exemplar, side).done();
}

}  // namespace gramloom::neural
