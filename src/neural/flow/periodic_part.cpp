#include "neural/flow/periodic_part.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gramloom::neural {

namespace {

// A place between two of the cells on a circle, and the share of the second.
struct Between {
  std::array<int, 2> cell;
  double second;
};

Between between(double phase, int cells) {
  const double at = (phase - std::floor(phase)) * cells;
  const int first = std::min(static_cast<int>(at), cells - 1);
  return {{first, (first + 1) % cells}, at - first};
}

template <class F>
void for_each_corner(Between x, Between y, F&& f) {
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 2; ++i)
      f(x.cell[i], y.cell[j], (i ? x.second : 1 - x.second) * (j ? y.second : 1 - y.second));
}

int cells_of(PeriodicAxis axis) {
  return axis.count > 0 ? std::max(1, static_cast<int>(std::lround(axis.period))) : 1;
}

double phase_in_exemplar(PeriodicAxis axis, int at) {
  return axis.count > 0 ? at / axis.period : 0;
}
double phase_in_picture(PeriodicAxis axis, int at, int side) {
  return static_cast<double>(at) * axis.count / side;
}

}  // namespace

Image periodic_part(const Image& exemplar, PeriodicAxis x, PeriodicAxis y, Size size) {
  const int channels = exemplar.channels;
  Image cell({cells_of(x), cells_of(y)}, channels), weight(cell.size(), 1);
  for (int v = 0; v < exemplar.height; ++v)
    for (int u = 0; u < exemplar.width; ++u)
      for_each_corner(between(phase_in_exemplar(x, u), cell.width),
                      between(phase_in_exemplar(y, v), cell.height),
                      [&](int i, int j, double share) {
                        for (int c = 0; c < channels; ++c)
                          cell.at(i, j)[c] += static_cast<float>(share) * exemplar.at(u, v)[c];
                        weight.at(i, j)[0] += static_cast<float>(share);
                      });
  for (int j = 0; j < cell.height; ++j)
    for (int i = 0; i < cell.width; ++i)
      for (int c = 0; c < channels; ++c) cell.at(i, j)[c] /= std::max(weight.at(i, j)[0], 1e-6f);
  Image result(size, channels);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u)
      for_each_corner(between(phase_in_picture(x, u, size.width), cell.width),
                      between(phase_in_picture(y, v, size.height), cell.height),
                      [&](int i, int j, double share) {
                        for (int c = 0; c < channels; ++c)
                          result.at(u, v)[c] += static_cast<float>(share) * cell.at(i, j)[c];
                      });
  return result;
}

}  // namespace gramloom::neural
