#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"

namespace gramloom::neural {

/// One of the processes is gone, or does not answer: what they were doing together is lost.
class GroupLost : public Error {
 public:
  using Error::Error;
};

/// The processes that make one texture together, seen from one of them. All of them call the same
/// functions in the same order, and wait there for each other.
/// This one is a group of one, which has nothing to say to anybody.
class Group {
 public:
  Group() = default;
  virtual ~Group() = default;
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  int rank() const { return rank_; }  // 0 to size − 1
  int size() const { return size_; }
  bool alone() const { return size_ == 1; }

  /// Each value becomes its sum, or the largest one, over all processes: the same bits in each.
  template <class T>
  void sum(std::span<T> values) const {
    if (!alone()) reduce(values.data(), values.size(), number_of(T()), false);
  }
  template <class T>
  void largest(std::span<T> values) const {
    if (!alone()) reduce(values.data(), values.size(), number_of(T()), true);
  }
  /// Those of the first process, in all of them.
  template <class T>
  void first(std::span<T> values) const {
    if (rank_ > 0)
      for (T& value : values) value = T{};
    sum(values);
  }
  /// Whether any of them says so.
  bool any(bool own) const {
    std::int32_t value = own;
    largest(std::span(&value, 1));
    return value != 0;
  }

  /// What goes to another process, or comes from it; several between two arrive in their order.
  struct Parcel {
    int peer;
    std::span<std::byte> bytes;
  };
  /// Sends and receives all of these at once.
  virtual void exchange(const std::vector<Parcel>& /*out*/,
                        const std::vector<Parcel>& /*in*/) const {}

  /// By this process so far, to all others.
  std::int64_t bytes_sent() const { return bytes_sent_; }

 protected:
  Group(int rank, int size) : rank_(rank), size_(size) {}
  enum class Number { float32, float64, int32 };
  virtual void reduce(void* /*values*/, std::size_t /*count*/, Number, bool /*largest*/) const {}

  mutable std::int64_t bytes_sent_ = 0;

 private:
  static Number number_of(float) { return Number::float32; }
  static Number number_of(double) { return Number::float64; }
  static Number number_of(std::int32_t) { return Number::int32; }

  int rank_ = 0, size_ = 1;
};

/// A group of one.
inline const Group& one_process() {
  static const Group group;
  return group;
}

}  // namespace gramloom::neural
