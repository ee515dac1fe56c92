#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "core/fields.h"
#include "core/request.h"

namespace gramloom {

/// What a method can do beyond a texture of some size.
enum class Ability {
  exemplar,   // makes a texture of a picture of one; without this ability it takes none
  exemplars,  // of several at once
  mask,       // leaves parts of an exemplar unused
  guide,      // follows a guide: what goes where
  mix,        // goes from one exemplar to another by weights
  turn,       // lays the exemplar turned and scaled, from place to place
  fill,       // keeps known pixels of the target and makes the others fit
  source      // copies whole pixels and says from where (Texture::source)
};
template <>
inline constexpr auto enum_names<Ability> = std::to_array<std::string_view>(
    {"exemplar", "several exemplars", "mask", "guide", "mix", "turn", "fill", "source"});

/// The abilities of a method: each params struct has a `static constexpr Abilities abilities`.
class Abilities {
 public:
  constexpr Abilities(std::initializer_list<Ability> abilities) {
    for (const Ability ability : abilities) bits_ |= bit(ability);
    // Turned copies of an exemplar are several, with masks and a guide (signal/turned.h).
    if (has(Ability::exemplars) && has(Ability::mask) && has(Ability::guide))
      bits_ |= bit(Ability::turn);
  }
  constexpr bool has(Ability ability) const { return (bits_ & bit(ability)) != 0; }

 private:
  static constexpr unsigned bit(Ability ability) { return 1u << static_cast<unsigned>(ability); }
  unsigned bits_ = 0;
};

/// An ability that a request asks for and the method lacks.
struct Lack {
  Ability ability;
  std::string refusal;  // "quilting cannot fill: a target's mask is given"
};

/// The first part of the request that a method of this kind with these abilities cannot honour.
std::optional<Lack> find_lack(std::string_view kind, Abilities abilities,
                              const RequestSize& request);

namespace detail {
void check_request(std::string_view kind, Abilities abilities, const RequestSize& request);
void check_request(std::string_view kind, Abilities abilities, const Request& request);
}  // namespace detail

/// What every method asks of its request, before its work and before its estimate. Throws Error
/// when the method lacks an ability that the request asks for; when a size, a number of channels or
/// the layers don't fit together; when weights are below 0 or all 0; when there is nothing to be
/// made, or of an exemplar nothing may be used; when an exemplar is empty, has more than 64
/// channels, or holds a value that is not finite or beyond ±1e15.
template <class Params>
void check_request(const Request& request) {
  detail::check_request(Params::kind, Params::abilities, request);
}
template <class Params>
void check_request(const RequestSize& request) {
  detail::check_request(Params::kind, Params::abilities, request);
}

/// The parts of that which ask for no method. Both throw Error.
void check_picture(const Image& exemplar);
void check_size(Size wanted);

}  // namespace gramloom
