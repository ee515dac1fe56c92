#include "surface/stochastic_tiling.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/neighbour.h"
#include "core/portable_math.h"
#include "core/threads.h"
#include "signal/united.h"

namespace gramloom {

namespace {

constexpr std::int64_t tiled_rows_at_once = 4;
constexpr int power_steps = 1024;

TilingLattice::Shape lattice_shape(Size exemplar, const TilingParams& params, Size result,
                                   Tile tile) {
  TilingLattice::Shape shape{exemplar, params.wraps, result, tile};
  shape.side = std::max(1.0, params.cell * std::min(exemplar.width, exemplar.height));
  shape.rotation = params.rotation;
  if (params.period.empty()) return shape;
  if (params.period.size() != 2)
    throw Error("period has {} numbers: two are needed, across and down", params.period.size());
  if (params.rotation > 0) throw Error("period and rotation: only one of them may be given");
  shape.period_x = params.period[0];
  shape.period_y = params.period[1];
  return shape;
}

// With more columns at its right, and one at its left, so that a piece that begins in it ends in
// it: those of its other side where it wraps, else its edge's.
Image widened(const Image& image, int more, bool wraps) {
  if (image.empty()) return {};
  Image wide(image.width + more + 1, image.height, image.channels);
  for (int y = 0; y < wide.height; ++y)
    for (int x = 0; x < wide.width; ++x)
      std::copy_n(image.at(neighbour(x - 1, image.width, wraps), y), image.channels, wide.at(x, y));
  return wide;
}

std::vector<float> powers_of_weights(double exponent) {
  std::vector<float> powers(power_steps + 2);
  for (std::size_t i = 0; i < powers.size(); ++i)
    powers[i] = static_cast<float>(portable::pow(static_cast<double>(i) / power_steps, exponent));
  return powers;
}

// Weights of the four values around a place between the middle two (Catmull, Rom 1974).
std::array<float, 4> cubic_weights(float t) {
  return {t * (-0.5f + t * (1 - 0.5f * t)), 1 + t * t * (-2.5f + 1.5f * t),
          t * (0.5f + t * (2 - 1.5f * t)), t * t * (-0.5f + 0.5f * t)};
}

// The image at a point, whose pixels' middles are at ½.
void sample_cubic(const Image& image, Tile wraps, double x, double y, float* values) {
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const auto across = cubic_weights(static_cast<float>(x - 0.5 - left));
  const auto down = cubic_weights(static_cast<float>(y - 0.5 - top));
  std::fill_n(values, image.channels, 0.0f);
  for (int row = 0; row < 4; ++row) {
    const int from_y = neighbour(static_cast<int>(top) + row - 1, image.height, tiles_y(wraps));
    for (int column = 0; column < 4; ++column) {
      const int from_x =
          neighbour(static_cast<int>(left) + column - 1, image.width, tiles_x(wraps));
      const float weight =
          across[static_cast<std::size_t>(column)] * down[static_cast<std::size_t>(row)];
      const float* from = image.at(from_x, from_y);
      for (int c = 0; c < image.channels; ++c) values[c] += weight * from[c];
    }
  }
}

using Weights = std::array<float, 3>;

// For blends of normal values: the sum of the squares becomes 1.
Weights to_unit_length(Weights w) {
  const float scale = 1 / std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  return {w[0] * scale, w[1] * scale, w[2] * scale};
}

Weights to_unit_sum(Weights w) {
  const float scale = 1 / (w[0] + w[1] + w[2]);
  return {w[0] * scale, w[1] * scale, w[2] * scale};
}

// Pixel after pixel; Channels 0: as many as there are.
template <int Channels, class WeightsOf>
void blend_run(std::array<const float*, 3> from, int channels, int count, float* to,
               WeightsOf&& weights_of) {
  const int each = Channels > 0 ? Channels : channels;
  for (int i = 0; i < count; ++i) {
    const Weights w = weights_of(i);
    for (int c = 0; c < each; ++c)
      to[c] = w[0] * from[0][c] + w[1] * from[1][c] + w[2] * from[2][c];
    for (const float*& pixel : from) pixel += each;
    to += each;
  }
}

// Where a piece may lie so that it takes usable pixels alone: see TilingLattice::keep_to().
std::vector<unsigned char> usable_places(const Image& mask, const TilingParams& params,
                                         const TilingLattice& lattice) {
  // A turned piece also takes the pixels that a cubic needs around it.
  const bool turned = params.rotation > 0;
  const int before = turned ? static_cast<int>(std::ceil(lattice.piece_radius())) + 2 : 0;
  const Size piece = turned ? Size{2 * before + 1, 2 * before + 1}
                            : Size{lattice.piece_width(), lattice.piece_height()};
  Image wide(mask.width + piece.width - 1, mask.height + piece.height - 1, 1);
  for (int y = 0; y < wide.height; ++y)
    for (int x = 0; x < wide.width; ++x)
      *wide.at(x, y) = *mask.at(neighbour(x - before, mask.width, tiles_x(params.wraps)),
                                neighbour(y - before, mask.height, tiles_y(params.wraps)));
  std::vector<unsigned char> usable = usable_origins(wide, wide.size(), piece);
  // Straight pieces end at an edge that doesn't wrap.
  const int columns = turned || tiles_x(params.wraps) ? mask.width : lattice.places().width;
  const int rows = turned || tiles_y(params.wraps) ? mask.height : lattice.places().height;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (x >= columns || y >= rows)
        usable[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
               static_cast<std::size_t>(x)] = 0;
  if (std::ranges::find(usable, 1) == usable.end())
    throw Error(
        "cell = {}: tiling needs usable pieces of {}×{} pixels, and the exemplar's mask leaves "
        "none; choose a smaller cell",
        params.cell, piece.width, piece.height);
  return usable;
}

}  // namespace

TilingLattice make_lattice(const TilingParams& params, Size exemplar, Size result, Tile tile,
                           Random random, const Image& mask) {
  TilingLattice lattice(lattice_shape(exemplar, params, result, tile), random);
  const Size places = lattice.places();
  // How far apart pieces may lie, and what of their size that is at least. An exemplar of a few
  // pixels has no room whatever the cell.
  const int room = places.width + places.height - 2, least = lattice.piece_width() / 4;
  if (params.cell > TilingParams().cell && room < least)
    throw Error(
        "cell = {}: pieces of {}×{} pixels have {}×{} places in an exemplar of {}×{}, so all would "
        "be nearly the same; choose a smaller cell, or say where the exemplar wraps",
        params.cell, lattice.piece_width(), lattice.piece_height(), places.width, places.height,
        exemplar.width, exemplar.height);
  if (!mask.empty()) lattice.keep_to(usable_places(mask, params, lattice));
  return lattice;
}

StochasticTiling::StochasticTiling(const Exemplar& exemplar, const TilingParams& params,
                                   Random random)
    : StochasticTiling(exemplar, params, {}, Tile::none, random) {}

StochasticTiling::StochasticTiling(const Exemplar& exemplar, const TilingParams& params, Size size,
                                   Tile tile, Random random)
    : params_(params),
      exemplar_(exemplar.image.size()),
      lattice_(make_lattice(params, exemplar_, size, tile, random, exemplar.mask)),
      values_(exemplar, params.blend),
      wide_values_(widened(values_.values(), lattice_.piece_width(), tiles_x(params.wraps))),
      wide_prominence_(
          widened(values_.prominence(), lattice_.piece_width(), tiles_x(params.wraps))),
      powers_(powers_of_weights(params.sharpness)) {}

// Shares of the triangle's corners to the power that the user chose, the largest of them 1.
std::array<float, 3> StochasticTiling::sharpened(std::array<float, 3> w) const {
  const float scale = power_steps / std::max({w[0], w[1], w[2]});
  for (float& weight : w) {
    const float place = std::max(weight, 0.0f) * scale;
    const auto below = static_cast<std::size_t>(place);
    weight = powers_[below] +
             (place - static_cast<float>(below)) * (powers_[below + 1] - powers_[below]);
  }
  return w;
}

void StochasticTiling::at(double x, double y, float* values) const {
  const auto corners = lattice_.around(x, y);
  Pieces pieces;
  std::array<float, 3> shares{};
  for (std::size_t i = 0; i < 3; ++i) {
    pieces[i] = lattice_.piece(corners[i].column, corners[i].row);
    shares[i] = static_cast<float>(corners[i].weight);
  }
  blend_at(pieces, shares, x, y, values);
  values_.restore(values, 1);
}

void StochasticTiling::blend_at(const Pieces& pieces, std::array<float, 3> shares, double x,
                                double y, float* values) const {
  Weights weights = sharpened(shares);
  std::array<std::array<float, 64>, 3> own;  // check_request() allows no more channels
  for (std::size_t i = 0; i < 3; ++i) {
    const TilingPiece& piece = pieces[i];
    const double from_x = piece.cosine * x - piece.sine * y + piece.x0;
    const double from_y = piece.sine * x + piece.cosine * y + piece.y0;
    sample_cubic(values_.values(), params_.wraps, from_x, from_y, own[i].data());
    turn_slopes(piece, own[i].data());
    if (params_.blend == TileBlend::histogram) continue;
    float prominence = 0;
    sample_cubic(values_.prominence(), params_.wraps, from_x, from_y, &prominence);
    weights[i] *= std::max(prominence, 0.1f);  // a cubic may go below 0
  }
  weights = params_.blend == TileBlend::histogram ? to_unit_length(weights) : to_unit_sum(weights);
  blend_run<0>({own[0].data(), own[1].data(), own[2].data()}, channels(), 1, values,
               [&](int) { return weights; });
}

// A surface that is turned has its slopes turned with it.
void StochasticTiling::turn_slopes(const TilingPiece& piece, float* values) const {
  const auto cosine = static_cast<float>(piece.cosine);
  for (std::size_t c = 0; c < values_.slopes().size(); ++c) {
    if (values_.slopes()[c] == 0) continue;
    const float sine = static_cast<float>(piece.sine) * values_.slopes()[c];
    const float right = values[c], up = values[c + 1];
    values[c] = cosine * right - sine * up;
    values[c + 1] = sine * right + cosine * up;
  }
}

void StochasticTiling::rows(int first, int count, int width, float* to) const {
  const std::size_t row_values =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(channels());
  parallel_for(count, tiled_rows_at_once, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = begin; i < end; ++i) {
      float* const row = to + static_cast<std::size_t>(i) * row_values;
      for (int x = 0; x < width;) x = run(x, first + static_cast<int>(i), width, row);
      values_.restore(row, width);
    }
  });
}

// Blends the pixels from x on that lie in one triangle of the lattice; the first one after them.
int StochasticTiling::run(int x, int y, int width, float* row) const {
  const double middle_y = y + 0.5;
  const auto corners = lattice_.around(x + 0.5, middle_y);
  const auto same = [&](int other) {
    const auto there = lattice_.around(other + 0.5, middle_y);
    return there[0].column == corners[0].column && there[0].row == corners[0].row &&
           there[1].row == corners[1].row;
  };
  // Along a row, a triangle is no longer than its side.
  int inside = x, outside = std::min(width, x + static_cast<int>(lattice_.across()) + 2);
  while (outside - inside > 1) {
    const int between = (inside + outside) / 2;
    (same(between) ? inside : outside) = between;
  }
  const auto last = lattice_.around(inside + 0.5, middle_y);

  Pieces pieces;
  std::array<float, 3> shares{}, steps{};
  for (std::size_t i = 0; i < 3; ++i) {
    pieces[i] = lattice_.piece(corners[i].column, corners[i].row);
    shares[i] = static_cast<float>(corners[i].weight);
    if (inside > x)
      steps[i] = static_cast<float>((last[i].weight - corners[i].weight) / (inside - x));
  }
  const auto shares_of = [&](int i) {
    const auto steps_done = static_cast<float>(i);
    return Weights{shares[0] + steps[0] * steps_done, shares[1] + steps[1] * steps_done,
                   shares[2] + steps[2] * steps_done};
  };
  float* const to = row + static_cast<std::size_t>(x) * static_cast<std::size_t>(channels());
  if (params_.rotation > 0)
    for (int i = 0; i < outside - x; ++i)
      blend_at(pieces, shares_of(i), x + i + 0.5, middle_y,
               to + static_cast<std::size_t>(i) * static_cast<std::size_t>(channels()));
  else
    blend_straight(pieces, x, y, outside - x, to, shares_of);
  return outside;
}

// Where a piece that is not turned has pixel (x, y) in a widened image.
const float* StochasticTiling::straight(const TilingPiece& piece, const Image& wide, int x,
                                        int y) const {
  const int column = static_cast<int>(x + piece.x0) + 1;
  const int row = neighbour(static_cast<int>(y + piece.y0), wide.height, tiles_y(params_.wraps));
  return wide.at(column, row);
}

template <class SharesOf>
void StochasticTiling::blend_straight(const Pieces& pieces, int x, int y, int count, float* to,
                                      SharesOf&& shares_of) const {
  std::array<const float*, 3> from{}, prominence{};
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = straight(pieces[i], wide_values_, x, y);
    if (!wide_prominence_.empty()) prominence[i] = straight(pieces[i], wide_prominence_, x, y);
  }
  const auto blend = [&](auto&& weights_of) {
    if (channels() == 3)
      blend_run<3>(from, 3, count, to, weights_of);
    else
      blend_run<0>(from, channels(), count, to, weights_of);
  };
  if (params_.blend == TileBlend::histogram)
    blend([&](int i) { return to_unit_length(sharpened(shares_of(i))); });
  else
    blend([&](int i) {
      Weights w = sharpened(shares_of(i));
      for (std::size_t k = 0; k < 3; ++k) w[k] *= prominence[k][i];
      return to_unit_sum(w);
    });
}

}  // namespace gramloom
