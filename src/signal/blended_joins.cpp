#include "signal/blended_joins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gramloom {

namespace {

constexpr int reach_in_blends = 6;  // of a shift, in blends: e⁻⁶ of it is left there
constexpr float enough = 1e-5f;     // of the largest pull: a sweep that changes no more is the last
/// At most: each leaves about 1 − 1.4 / blend of the error.
constexpr int most_sweeps(int blend) { return 20 + 8 * blend; }

struct JoinSide {
  int x, y;
};
constexpr std::array<JoinSide, 4> join_sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// A new pixel near a join.
struct BandPixel {
  int x, y;
  int distance;                               // steps from what is known
  std::array<int, 4> beside{-1, -1, -1, -1};  // the band's pixels at its sides
  float links = 0;                            // sides that pull at its shift
};

/// The channels of layers of these kinds.
std::vector<int> channels_of(const Request& request, const std::vector<MapKind>& kinds) {
  const Exemplar& exemplar = request.exemplars.front();
  std::vector<Layer> layers = exemplar.layers;
  if (layers.empty()) layers = {{"", MapKind::colour, 0, exemplar.image.channels}};
  std::vector<int> channels;
  for (const Layer& layer : layers)
    if (std::ranges::find(kinds, layer.kind) != kinds.end())
      for (int c = layer.first; c < layer.first + layer.count; ++c) channels.push_back(c);
  return channels;
}

/// The new pixels near what is known, those at it first.
class JoinBand {
 public:
  JoinBand(const Texture& texture, const Request& request)
      : texture_(texture),
        request_(request),
        target_(request.target),
        alphas_(channels_of(request, {MapKind::alpha})),
        numbers_(pixel_count(target_.size), -1) {
    for (int y = 0; y < target_.size.height; ++y)
      for (int x = 0; x < target_.size.width; ++x)
        if (is_made(x, y) && at_known(x, y)) add(x, y, 0);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const BandPixel from = pixels_[i];
      if (from.distance + 1 < reach_in_blends * target_.blend)
        for_each_neighbour(from.x, from.y, [&](JoinSide, int u, int v) {
          if (is_made(u, v) && number(u, v) < 0) add(u, v, from.distance + 1);
        });
    }
  }

  const std::vector<BandPixel>& pixels() const { return pixels_; }

  /// Links the pixels, and returns what each is pulled to by the joins at it: of the channels.
  std::vector<float> pulls(const std::vector<int>& channels) {
    std::vector<float> result(pixels_.size() * channels.size(), 0.0f);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      BandPixel& pixel = pixels_[i];
      std::size_t side_number = 0;
      for (const JoinSide side : join_sides) {
        const std::size_t s = side_number++;
        int u = pixel.x, v = pixel.y;
        if (!neighbour(u, v, side)) continue;
        if (is_made(u, v)) {
          pixel.beside[s] = number(u, v);
          ++pixel.links;
        } else if (const float* beside = beside_source(pixel, side);
                   beside && is_seen(beside) && is_seen(target_.known.at(u, v)) &&
                   is_seen(texture_.image.at(pixel.x, pixel.y))) {
          ++pixel.links;
          add_lack(pixel, beside, u, v, channels, result.data() + i * channels.size());
        }
      }
    }
    return result;
  }

  /// Takes the pulls from each hole most of whose pixels at joins were copied alone, beside no
  /// neighbour of their source: such have no steps to keep.
  void drop_single_copies(std::vector<float>& pulls, std::size_t channels) const {
    std::vector<bool> seen(pixels_.size(), false);
    for (std::size_t first = 0; first < pixels_.size(); ++first) {
      if (seen[first]) continue;
      seen[first] = true;
      std::vector<std::size_t> hole{first};
      int joins = 0, together = 0;
      for (std::size_t i = 0; i < hole.size(); ++i) {
        const BandPixel& pixel = pixels_[hole[i]];
        if (pixel.distance == 0) {
          ++joins;
          together += is_of_piece(pixel.x, pixel.y) ? 1 : 0;
        }
        for (const int beside : pixel.beside)
          if (beside >= 0 && !seen[to_size(beside)]) {
            seen[to_size(beside)] = true;
            hole.push_back(to_size(beside));
          }
      }
      if (2 * together >= joins) continue;
      for (const std::size_t i : hole)
        std::fill_n(pulls.begin() + static_cast<std::ptrdiff_t>(i * channels), channels, 0.0f);
    }
  }

 private:
  std::size_t index(int x, int y) const {
    return to_size(y) * to_size(target_.size.width) + to_size(x);
  }
  bool is_made(int x, int y) const { return *target_.mask.at(x, y) > 0.5f; }
  int number(int x, int y) const { return numbers_[index(x, y)]; }

  bool neighbour(int& x, int& y, JoinSide side) const {
    const auto [width, height] = target_.size;
    x += side.x;
    y += side.y;
    if (tiles_x(target_.tile)) x = (x + width) % width;
    if (tiles_y(target_.tile)) y = (y + height) % height;
    return x >= 0 && y >= 0 && x < width && y < height;
  }
  template <class F>
  void for_each_neighbour(int x, int y, F&& f) const {
    for (const JoinSide side : join_sides)
      if (int u = x, v = y; neighbour(u, v, side)) f(side, u, v);
  }

  bool at_known(int x, int y) const {
    bool known = false;
    for_each_neighbour(x, y, [&](JoinSide, int u, int v) { known |= !is_made(u, v); });
    return known;
  }

  void add(int x, int y, int distance) {
    numbers_[index(x, y)] = static_cast<int>(pixels_.size());
    pixels_.push_back({x, y, distance});
  }

  /// Whether a new neighbour was copied with it.
  bool is_of_piece(int x, int y) const {
    const Source own = *texture_.source.at(x, y);
    bool found = false;
    for_each_neighbour(x, y, [&](JoinSide side, int u, int v) {
      if (!is_made(u, v)) return;
      const Source other = *texture_.source.at(u, v);
      found |= other.exemplar == own.exemplar &&
               static_cast<int>(other.x) == static_cast<int>(own.x) + side.x &&
               static_cast<int>(other.y) == static_cast<int>(own.y) + side.y;
    });
    return found;
  }

  /// Colours of what is transparent say nothing.
  bool is_seen(const float* pixel) const {
    return std::ranges::all_of(alphas_, [&](int c) { return pixel[c] > 0.5f; });
  }

  /// What lies beside the source, if that may be used.
  const float* beside_source(const BandPixel& pixel, JoinSide side) const {
    const Source source = *texture_.source.at(pixel.x, pixel.y);
    const Exemplar& exemplar = request_.exemplars[source.exemplar];
    const int x = static_cast<int>(source.x) + side.x;
    const int y = static_cast<int>(source.y) + side.y;
    if (x < 0 || y < 0 || x >= exemplar.image.width || y >= exemplar.image.height) return nullptr;
    if (!exemplar.mask.empty() && *exemplar.mask.at(x, y) <= 0.5f) return nullptr;
    return exemplar.image.at(x, y);
  }

  /// Adds what the pixel must be shifted by for its step to the known (u, v) to be its source's.
  void add_lack(const BandPixel& pixel, const float* beside, int u, int v,
                const std::vector<int>& channels, float* sums) const {
    const Source source = *texture_.source.at(pixel.x, pixel.y);
    const float* own = request_.exemplars[source.exemplar].image.at(static_cast<int>(source.x),
                                                                    static_cast<int>(source.y));
    const float* made = texture_.image.at(pixel.x, pixel.y);
    const float* known = target_.known.at(u, v);
    for (std::size_t k = 0; k < channels.size(); ++k) {
      const int c = channels[k];
      sums[k] += known[c] - beside[c] + own[c] - made[c];
    }
  }

  const Texture& texture_;
  const Request& request_;
  const Target& target_;
  std::vector<int> alphas_;   // channels
  std::vector<int> numbers_;  // of a target's pixel in the band; −1: none
  std::vector<BandPixel> pixels_;
};

/// Solves the band's equations by successive over-relaxation, one pixel after the other: the same
/// for any number of threads.
std::vector<float> shifts_of(const std::vector<BandPixel>& pixels, const std::vector<float>& pulls,
                             std::size_t channels, int blend) {
  const float screen = 1 / static_cast<float>(blend * blend);
  const float radius = 4 / (4 + screen);  // of Jacobi's iteration, inside
  const float relaxation = 2 / (1 + std::sqrt(1 - radius * radius));
  float largest = 0;
  for (const float pull : pulls) largest = std::max(largest, std::abs(pull));
  std::vector<float> shifts(pulls.size(), 0.0f);
  for (int sweep = 0; sweep < most_sweeps(blend); ++sweep) {
    float change = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const BandPixel& pixel = pixels[i];
      for (std::size_t k = 0; k < channels; ++k) {
        float sum = pulls[i * channels + k];
        for (const int beside : pixel.beside)
          if (beside >= 0) sum += shifts[to_size(beside) * channels + k];
        float& shift = shifts[i * channels + k];
        const float step = relaxation * (sum / (pixel.links + screen) - shift);
        shift += step;
        change = std::max(change, std::abs(step));
      }
    }
    if (change <= enough * largest) break;
  }
  return shifts;
}

}  // namespace

void blend_joins(Texture& texture, const Request& request) {
  const Target& target = request.target;
  if (target.blend <= 0 || target.known.empty() || target.mask.empty() || texture.source.empty())
    return;
  const std::vector<int> channels = channels_of(request, {MapKind::colour, MapKind::scalar});
  JoinBand band(texture, request);
  std::vector<float> pulls = band.pulls(channels);
  band.drop_single_copies(pulls, channels.size());
  const std::vector<float> shifts = shifts_of(band.pixels(), pulls, channels.size(), target.blend);
  const ChannelRange range = channel_range(texture.image);
  for (std::size_t i = 0; i < band.pixels().size(); ++i) {
    float* pixel = texture.image.at(band.pixels()[i].x, band.pixels()[i].y);
    for (std::size_t k = 0; k < channels.size(); ++k) {
      const std::size_t c = to_size(channels[k]);
      pixel[c] =
          std::clamp(pixel[c] + shifts[i * channels.size() + k], range.low[c], range.high[c]);
    }
  }
}

}  // namespace gramloom
