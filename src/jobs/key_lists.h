#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "io/json_fields.h"

namespace gramloom {

// The field lists in words: what `gramloom list`, the manual, completions and new configs say of a
// key is read here.

/// A key of a config, or a parameter.
struct Key {
  std::string name;
  std::string type;  // "integer", "list of number"
  Json standard;     // its default; null: none
  std::string allowed;
  std::optional<double> min, max;  // of numbers that have a limit
  std::vector<std::string> words;  // of a key that is one of some words
  std::string unit;
  std::string description;

  static constexpr auto fields() {
    using K = Key;
    return std::tuple{
        Field{"name", &K::name, "what the config calls it"},
        Field{"type", &K::type, "of its value"},
        Field{"default", &K::standard, "its value where nothing is said"},
        Field{"allowed", &K::allowed, "what it may be, in words"},
        Field{"min", &K::min, "the least number"},
        Field{"max", &K::max, "the largest number"},
        Field{"words", &K::words, "the words that it may be"},
        Field{"unit", &K::unit, "of the number"},
        Field{"description", &K::description, "what it does"},
    };
  }
};

/// The default as a config writes it; "" for none.
std::string default_text(const Key& key);
/// The description with the unit.
std::string meaning_of(const Key& key);

/// The keys of one method, of one procedural texture, of a table of the config.
struct KeyList {
  std::string name;
  std::string summary;
  std::vector<std::string> abilities;  // of a method
  std::vector<Key> keys;

  static constexpr auto fields() {
    using L = KeyList;
    return std::tuple{
        Field{"name", &L::name, "of the method, the texture or the table"},
        Field{"summary", &L::summary, "what it is"},
        Field{"abilities", &L::abilities, "what the method can be asked"},
        Field{"parameters", &L::keys, "its keys"},
    };
  }
};

/// Every method, by its kind.
std::vector<KeyList> method_lists();
/// The settings of each preset: the method's keys with other defaults. Named "neural, fast".
std::vector<KeyList> preset_lists();
/// Every procedural texture; all have the keys of the method besides.
std::vector<KeyList> texture_lists();
/// [guide] and its like.
std::vector<KeyList> direction_lists();
/// Each kind of [[model]].
std::vector<KeyList> model_lists();
/// What is made of heights and photographs: [surface], of `maps` alone, [preview].
std::vector<KeyList> map_lists();
/// What a simulation of a sleeve is told.
std::vector<KeyList> simulation_lists();
/// A config by its tables, "[[exemplar]]", first what stands above them all; without the keys of
/// each kind of [[method]] and [[model]].
std::vector<KeyList> table_lists();

}  // namespace gramloom
