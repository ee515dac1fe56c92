#include "neural/shared_rows.h"

#include <algorithm>

namespace gramloom::neural {

namespace {

struct Owned {
  int owner;
  Rows wanted, own;  // counted from the first wanted row, and from the owner's first
};

// Who owns the rows that are wanted.
std::vector<Owned> owners_of(Rows wanted, std::int64_t height, int size) {
  std::vector<Owned> result;
  for (std::int64_t row = wanted.begin; row < wanted.end;) {
    const std::int64_t turn = floor_divided(row, height) * height, inside = row - turn;
    int owner = static_cast<int>(inside * size / height);
    while (share_of(height, owner, size).end <= inside) ++owner;
    const Rows own = share_of(height, owner, size);
    const std::int64_t count = std::min(wanted.end - row, own.end - inside);
    result.push_back({owner,
                      {row - wanted.begin, row - wanted.begin + count},
                      {inside - own.begin, inside - own.begin + count}});
    row += count;
  }
  return result;
}

at::Tensor rows_of(const at::Tensor& data, Rows rows) {
  return data.narrow(1, rows.begin, rows.count());
}

std::span<std::byte> bytes_of(const at::Tensor& tensor) {
  return {static_cast<std::byte*>(tensor.data_ptr()), tensor.nbytes()};
}

std::vector<std::int64_t> with_rows(const at::Tensor& like, std::int64_t rows) {
  std::vector<std::int64_t> shape = like.sizes().vec();
  shape[1] = rows;
  return shape;
}

// Calls f(i, what came) for each of `in`.
template <class Pieces, class F>
void swap(const Group& group, const at::Tensor& data, const Pieces& out, const Pieces& in, F&& f) {
  std::vector<at::Tensor> going, coming;
  std::vector<Group::Parcel> outward, inward;
  for (const auto& [peer, rows] : out) {
    going.push_back(rows_of(data, rows).contiguous());
    outward.push_back({peer, bytes_of(going.back())});
  }
  for (const auto& [peer, rows] : in) {
    coming.push_back(at::empty(with_rows(data, rows.count()), data.options()));
    inward.push_back({peer, bytes_of(coming.back())});
  }
  group.exchange(outward, inward);
  for (std::size_t i = 0; i < in.size(); ++i) f(in[i].rows, coming[i]);
}

}  // namespace

RowExchange::RowExchange(const Group& group, std::int64_t height, Rows wanted)
    : group_(group), height_(height), wanted_(wanted), own_(own_rows(group, height)) {
  if (group.alone()) return;
  const auto place = [&](int rank) { return 2 * static_cast<std::size_t>(rank); };
  std::vector<std::int32_t> all(place(group.size()));
  all[place(group.rank())] = static_cast<std::int32_t>(wanted.begin);
  all[place(group.rank()) + 1] = static_cast<std::int32_t>(wanted.end);
  group.sum(std::span(all));
  for (int peer = 0; peer < group.size(); ++peer)
    for (const Owned& owned :
         owners_of({all[place(peer)], all[place(peer) + 1]}, height, group.size())) {
      if (owned.owner == group.rank()) asked_.push_back({peer, owned.own});
      if (peer == group.rank()) wished_.push_back({owned.owner, owned.wanted});
    }
}

HeldRows RowExchange::take(const HeldRows& own) const {
  if (group_.alone()) return own;
  const at::Tensor data = own.data.detach();
  const at::Tensor taken = at::empty(with_rows(data, wanted_.count()), data.options());
  // What one asks of oneself needs no sending.
  std::vector<Piece> out, in, from, to;
  for (const Piece& piece : asked_) (piece.peer == group_.rank() ? from : out).push_back(piece);
  for (const Piece& piece : wished_) (piece.peer == group_.rank() ? to : in).push_back(piece);
  for (std::size_t i = 0; i < to.size(); ++i)
    rows_of(taken, to[i].rows).copy_(rows_of(data, from[i].rows));
  swap(group_, data, out, in,
       [&](Rows rows, const at::Tensor& came) { rows_of(taken, rows).copy_(came); });
  return {taken, own.channels, wanted_, height_};
}

at::Tensor RowExchange::give_back(const at::Tensor& of_taken) const {
  if (group_.alone()) return of_taken;
  at::Tensor of_own = at::zeros(with_rows(of_taken, own_.count()), of_taken.options());
  add_back(of_taken, of_own);
  return of_own;
}

void RowExchange::add_back(const at::Tensor& of_taken, at::Tensor& of_own) const {
  std::vector<Piece> out, in, from, to;
  for (const Piece& piece : wished_) (piece.peer == group_.rank() ? from : out).push_back(piece);
  for (const Piece& piece : asked_) (piece.peer == group_.rank() ? to : in).push_back(piece);
  for (std::size_t i = 0; i < to.size(); ++i)
    rows_of(of_own, to[i].rows).add_(rows_of(of_taken, from[i].rows));
  swap(group_, of_taken, out, in,
       [&](Rows rows, const at::Tensor& came) { rows_of(of_own, rows).add_(came); });
}

void sum_all(const Group& group, const std::vector<at::Tensor>& tensors) {
  if (group.alone() || tensors.empty()) return;
  std::vector<at::Tensor> flat;
  for (const at::Tensor& tensor : tensors) flat.push_back(tensor.reshape({-1}));
  const at::Tensor all = at::cat(flat);
  if (all.scalar_type() == at::kDouble)
    group.sum(std::span(all.data_ptr<double>(), static_cast<std::size_t>(all.numel())));
  else
    group.sum(std::span(all.data_ptr<float>(), static_cast<std::size_t>(all.numel())));
  std::int64_t first = 0;
  for (const at::Tensor& tensor : tensors) {
    tensor.copy_(all.narrow(0, first, tensor.numel()).view(tensor.sizes()));
    first += tensor.numel();
  }
}

double sum_of(const Group& group, double value) {
  group.sum(std::span(&value, 1));
  return value;
}

at::Tensor from_first(const Group& group, const at::Tensor& tensor) {
  if (group.alone()) return tensor;
  const at::Tensor result = group.rank() == 0 ? tensor.clone() : at::zeros_like(tensor);
  sum_all(group, {result});
  return result;
}

}  // namespace gramloom::neural
