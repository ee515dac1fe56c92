#pragma once

#include "neural/group.h"
#include "neural/network/rows.h"

namespace gramloom::neural {

// A picture that several processes have together: each holds its own rows.

/// The rows of a picture of `height` that are this process' own.
inline Rows own_rows(const Group& group, std::int64_t height) {
  return share_of(height, group.rank(), group.size());
}
/// A picture of which these are the own rows.
inline HeldRows held_by(const Group& group, const at::Tensor& own, std::int64_t height) {
  return {own, own.size(0), own_rows(group, height), height};
}

/// Rows that are looked at beside the own ones, from whoever has them. Around a circle, where rows
/// lie beyond the edges.
class RowExchange {
 public:
  /// All processes say at once what they want of a picture of `height`.
  RowExchange(const Group& group, std::int64_t height, Rows wanted);

  /// The rows that are wanted; in a group of one, all that there are: the own ones.
  HeldRows take(const HeldRows& own) const;
  /// The transpose: the gradient of the own rows from that of the rows that each process took.
  at::Tensor give_back(const at::Tensor& of_taken) const;
  /// The same, added to that of the own rows. Not for a group of one.
  void add_back(const at::Tensor& of_taken, at::Tensor& of_own) const;

 private:
  struct Piece {
    int peer;
    Rows rows;  // counted from the first row of those that are taken, or of one's own
  };
  const Group& group_;
  std::int64_t height_;
  Rows wanted_, own_;
  std::vector<Piece> asked_, wished_;  // from this one by others, and by this one of others
};

/// Each value of these becomes its sum over all processes.
void sum_all(const Group& group, const std::vector<at::Tensor>& tensors);
double sum_of(const Group& group, double value);
/// The first process' tensor, in all of them.
at::Tensor from_first(const Group& group, const at::Tensor& tensor);

}  // namespace gramloom::neural
