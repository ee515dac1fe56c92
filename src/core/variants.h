#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace gramloom {

namespace detail {
template <class V, class F, std::size_t... I>
void for_each_alternative(F&& f, std::index_sequence<I...>) {
  (f(std::type_identity<std::variant_alternative_t<I, V>>{}), ...);
}
}  // namespace detail

/// Calls f(std::type_identity<Alternative>{}) for every alternative of the variant V in order.
template <class V, class F>
void for_each_alternative(F&& f) {
  detail::for_each_alternative<V>(f, std::make_index_sequence<std::variant_size_v<V>>{});
}

/// Calls f(std::type_identity<Alternative>{}) for the alternative of V with this index.
template <class V, class F>
void with_alternative(std::size_t wanted, F&& f) {
  std::size_t index = 0;
  for_each_alternative<V>([&](auto type) {
    if (index++ == wanted) f(type);
  });
}

}  // namespace gramloom
