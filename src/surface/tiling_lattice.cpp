#include "surface/tiling_lattice.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/portable_math.h"

namespace gramloom {

namespace {

// Random places that are tried for a piece before the nearest usable one is looked for.
constexpr int tries = 256;

std::int64_t floor_divide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

// How many places there are for a piece of `length` pixels.
int places(int side, int length, bool wraps) {
  return wraps ? side : std::max(1, side - length + 1);
}

// Wherever a piece lies, a multiple of the period must be among its places.
void check_period(double period, int places, int length, std::string_view way) {
  const double needed = std::ceil(period) + (period == std::floor(period) ? 0 : 1);
  if (places < needed)
    throw Error(
        "period = {} {}: pieces of {} pixels have only {} places that way, so no multiple fits "
        "some of them; choose a smaller cell or a period up to {}",
        period, way, length, places, places);
}

// With as many places as the period is long, each piece has one multiple: the picture itself again.
void check_choice(const TilingLattice::Shape& shape, Size places) {
  const bool periodic = shape.period_x > 1 || shape.period_y > 1;
  if (periodic && places.width <= shape.period_x && places.height <= shape.period_y)
    throw Error(
        "period = {},{}: every piece would be from the same place of the picture of {}×{} pixels, "
        "which would only be repeated; choose a shorter period, or a larger picture",
        shape.period_x, shape.period_y, shape.exemplar.width, shape.exemplar.height);
}

// A random whole number from `least` on, of `count`, that is a multiple of `period`, rounded.
double random_shift(double least, int count, double period, Random& random) {
  const double first = std::ceil(least / period), last = std::floor((least + count - 1) / period);
  const auto multiples = static_cast<std::uint32_t>(last - first) + 1;
  return std::round((first + random.below(multiples)) * period);
}

// A random middle for a disc of this radius.
double disc_middle(int side, double radius, bool wraps, Random& random) {
  const double share = random.uniform();
  return wraps ? share * side : radius + share * std::max(0.0, side - 2 * radius);
}

}  // namespace

TilingLattice::TilingLattice(const Shape& shape, Random random)
    : shape_(shape),
      random_(random),
      across_(shape.side),
      down_(shape.side * portable::sqrt(3) / 2) {
  if (tiles_x(shape.tiles)) {
    columns_ = static_cast<std::int64_t>(std::ceil(shape.result.width / across_));
    across_ = static_cast<double>(shape.result.width) / static_cast<double>(columns_);
  }
  if (tiles_y(shape.tiles)) {  // every other row begins at the same place
    rows_ = 2 * static_cast<std::int64_t>(std::ceil(shape.result.height / (2 * down_)));
    down_ = static_cast<double>(shape.result.height) / static_cast<double>(rows_);
  }
  if (shape.rotation > 0) return;
  check_period(shape.period_x, places().width, piece_width(), "across");
  check_period(shape.period_y, places().height, piece_height(), "down");
  check_choice(shape, places());
}

double TilingLattice::piece_radius() const {
  return std::max(across_, portable::sqrt(across_ * across_ / 4 + down_ * down_));
}

Size TilingLattice::places() const {
  const Size from = shape_.exemplar;
  const bool turned = shape_.rotation > 0;
  const int across = turned ? static_cast<int>(2 * piece_radius()) + 1 : piece_width();
  const int down = turned ? across : piece_height();
  return {gramloom::places(from.width, across, tiles_x(shape_.wraps)),
          gramloom::places(from.height, down, tiles_y(shape_.wraps))};
}

std::array<TilingCorner, 3> TilingLattice::around(double x, double y) const {
  const double v = y / down_;
  const double u = x / across_ - v / 2;
  const auto column = static_cast<std::int64_t>(std::floor(u));
  const auto row = static_cast<std::int64_t>(std::floor(v));
  const double along = u - std::floor(u), up = v - std::floor(v);
  const TilingCorner right{column + 1, row, along}, above{column, row + 1, up};
  if (along + up < 1) return {{{column, row, 1 - along - up}, right, above}};
  return {{{column + 1, row + 1, along + up - 1},
           {right.column, right.row, 1 - up},
           {above.column, above.row, 1 - along}}};
}

bool TilingLattice::is_usable(double x, double y) const {
  if (usable_.empty()) return true;
  const auto wrapped = [](double value, int length) {
    const auto i = static_cast<std::int64_t>(std::floor(value));
    return static_cast<std::size_t>(i - floor_divide(i, length) * length);
  };
  return usable_[wrapped(y, shape_.exemplar.height) *
                     static_cast<std::size_t>(shape_.exemplar.width) +
                 wrapped(x, shape_.exemplar.width)] != 0;
}

TilingLattice::Point TilingLattice::nearest_usable(double x, double y) const {
  Point nearest{};
  double least = INFINITY;
  for (int v = 0; v < shape_.exemplar.height; ++v)
    for (int u = 0; u < shape_.exemplar.width; ++u) {
      if (!is_usable(u, v)) continue;
      const double distance = (u - x) * (u - x) + (v - y) * (v - y);
      if (distance < least) {
        least = distance;
        nearest = {1.0 * u, 1.0 * v};
      }
    }
  return nearest;
}

TilingPiece TilingLattice::piece(std::int64_t column, std::int64_t row) const {
  // The point of the first period that has this piece, and how far away that is.
  std::int64_t periods_right = 0, periods_down = 0;
  if (rows_ > 0) {
    periods_down = floor_divide(row, rows_);
    row -= periods_down * rows_;
    column += periods_down * rows_ / 2;
  }
  if (columns_ > 0) {
    periods_right = floor_divide(column, columns_);
    column -= periods_right * columns_;
  }
  const double right = static_cast<double>(periods_right) * shape_.result.width;
  const double down = static_cast<double>(periods_down) * shape_.result.height;
  const double x = across_ * (static_cast<double>(column) + static_cast<double>(row) / 2);
  const double y = down_ * static_cast<double>(row);

  const auto key =
      (static_cast<std::uint64_t>(column) << 32) ^ (static_cast<std::uint64_t>(row) & 0xFFFFFFFFu);
  Random random = random_.stream(key);
  const Size from = shape_.exemplar;
  const bool wraps_x = tiles_x(shape_.wraps), wraps_y = tiles_y(shape_.wraps);
  if (!(shape_.rotation > 0)) {
    const double left = std::ceil(x - across_ - 0.5), top = std::ceil(y - down_ - 0.5);
    for (int i = 0;; ++i) {
      const double x0 = random_shift(-left, places().width, shape_.period_x, random);
      const double y0 = random_shift(-top, places().height, shape_.period_y, random);
      if (is_usable(left + x0, top + y0)) return {1, 0, x0 - right, y0 - down};
      if (i < tries) continue;
      const Point nearest = nearest_usable(left + x0, top + y0);
      return {1, 0, nearest.x - left - right, nearest.y - top - down};
    }
  }
  const double radius = piece_radius();
  double middle_x = disc_middle(from.width, radius, wraps_x, random);
  double middle_y = disc_middle(from.height, radius, wraps_y, random);
  for (int i = 0; i < tries && !is_usable(middle_x, middle_y); ++i) {
    middle_x = disc_middle(from.width, radius, wraps_x, random);
    middle_y = disc_middle(from.height, radius, wraps_y, random);
  }
  if (!is_usable(middle_x, middle_y)) {
    const Point nearest = nearest_usable(middle_x, middle_y);
    middle_x = nearest.x + 0.5;
    middle_y = nearest.y + 0.5;
  }
  const double angle = shape_.rotation * portable::pi / 180 * (2.0 * random.uniform() - 1);
  const double cosine = portable::cos(angle), sine = portable::sin(angle);
  const double result_x = x + right, result_y = y + down;
  return {cosine, sine, middle_x - cosine * result_x + sine * result_y,
          middle_y - sine * result_x - cosine * result_y};
}

}  // namespace gramloom
