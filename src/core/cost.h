#pragma once

namespace gramloom {

/// How long something takes, by what it waits for, so that it can be told for any machine.
struct Work {
  double serial = 0;      // seconds of one thread of the machine that the figures were measured on
  double shared = 0;      // the same, of work that all threads share
  double operations = 0;  // of matrix products and convolutions, which all threads share

  Work& operator+=(const Work& other) {
    serial += other.serial;
    shared += other.shared;
    operations += other.operations;
    return *this;
  }
  friend Work operator+(Work a, const Work& b) { return a += b; }
  friend Work operator*(double factor, const Work& work) {
    return {factor * work.serial, factor * work.shared, factor * work.operations};
  }
};

/// Of a machine, against the one that the figures were measured on; by default that one, with two
/// threads (of an Intel Xeon with AVX-512, two threads of one core).
struct Speed {
  double serial = 1;           // of one thread
  double shared = 1.5;         // of all threads together
  double operations = 2.2e11;  // of matrix products a second, of all threads together
};

/// Seconds that the work takes at this speed.
inline double seconds(const Work& work, const Speed& speed = {}) {
  return work.serial / speed.serial + work.shared / speed.shared +
         work.operations / speed.operations;
}

/// What a piece of work is expected to need: for `check`, for refusing a job that does not fit, and
/// for shares of equal work.
struct Cost {
  double bytes = 0;  // peak memory of the process beyond its start
  Work work;
};

}  // namespace gramloom
