#include "jobs/key_lists.h"

#include "core/variants.h"
#include "jobs/config.h"
#include "jobs/simulation.h"
#include "surface/photo.h"

namespace gramloom {

namespace {

template <class T>
std::string type_of() {
  if constexpr (is_optional<T>) {
    return type_of<typename T::value_type>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return "boolean";
  } else if constexpr (std::is_same_v<T, Size>) {
    return "size";
  } else if constexpr (is_number<T>) {
    return std::is_integral_v<T> ? "integer" : "number";
  } else if constexpr (NamedEnum<T>) {
    return "word";
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return "file";
  } else if constexpr (std::is_same_v<T, FileOrName>) {
    return "name or file";
  } else if constexpr (is_named_files<T>) {
    return "table of files";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "text";
  } else {
    return "list of " + type_of<element_t<T>>();
  }
}

template <class T>
struct WithoutOptional {
  using type = T;
};
template <class T>
struct WithoutOptional<std::optional<T>> {
  using type = T;
};

template <class T>
std::vector<std::string> words_of() {
  using Plain = element_t<typename WithoutOptional<T>::type>;
  if constexpr (NamedEnum<Plain>)
    return {enum_names<Plain>.begin(), enum_names<Plain>.end()};
  else if constexpr (std::is_same_v<Plain, bool>)
    return {"true", "false"};
  else
    return {};
}

template <class T>
Key key_of(const FieldText& field, const T& standard) {
  const Range anything;
  Key key{std::string(field.name),
          type_of<T>(),
          value_to_json(standard, {}),
          allowed_values<T>(field.range),
          {},
          {},
          words_of<T>(),
          std::string(field.unit),
          std::string(field.meaning)};
  if (field.range.min > anything.min) key.min = field.range.min;
  if (field.range.max < anything.max) key.max = field.range.max;
  return key;
}

template <class Params>
std::vector<Key> keys_of(const Params& defaults = {}) {
  std::vector<Key> keys;
  for_each_value(defaults, [&](const FieldText& field, const auto& standard) {
    keys.push_back(key_of(field, standard));
  });
  return keys;
}

// A key that is read before the field list is known.
Key first_key(const std::string& name, const std::string& allowed, const std::string& description,
              std::vector<std::string> words = {}) {
  return {name,
          words.empty() ? "text" : "word",
          Json(nullptr),
          allowed,
          {},
          {},
          std::move(words),
          "",
          description};
}

std::string word_list(const std::vector<std::string>& words) {
  return fmt::format("one of {}", fmt::join(words, ", "));
}

std::vector<std::string> names_of(const std::vector<KeyList>& lists) {
  std::vector<std::string> names;
  for (const KeyList& list : lists) names.push_back(list.name);
  return names;
}

template <class... Params>
std::vector<KeyList> named_lists() {
  return {
      KeyList{std::string(Params::name), std::string(Params::summary), {}, keys_of<Params>()}...};
}

template <class Params>
KeyList method_list(const Params& defaults) {
  KeyList list{std::string(Params::kind), std::string(Params::summary), {}, {}};
  for (std::size_t i = 0; i < enum_names<Ability>.size(); ++i)
    if (Params::abilities.has(static_cast<Ability>(i)))
      list.abilities.emplace_back(enum_names<Ability>[i]);
  if constexpr (HasVariant<Params>)
    list.keys.push_back(
        first_key(std::string(Params::variant_key), "a name",
                  "which one, with its own parameters: see 'gramloom list patterns'",
                  names_of(texture_lists())));
  std::ranges::move(keys_of(defaults), std::back_inserter(list.keys));
  return list;
}

KeyList exemplar_list() {
  KeyList list{"[[exemplar]]", "what textures are made from; as many as you like", {}, {}};
  list.keys = {
      first_key("name", "a text", "yours to choose: it names the folder of the results"),
      first_key("images", "a list of files, folders or tables",
                "in place of image: several pictures of one material, each a file, a folder of "
                "some, or a table { image, maps, mask, guide }"),
      first_key("folder", "a folder",
                "in place of image: each picture in it is an exemplar, called like its file")};
  std::ranges::move(keys_of<ExemplarEntry>(), std::back_inserter(list.keys));
  return list;
}

KeyList kinds_list(const std::string& name, const std::string& summary,
                   const std::vector<KeyList>& kinds) {
  const std::vector<std::string> words = names_of(kinds);
  return {name,
          summary,
          {},
          {first_key("name", "a text", "yours to choose: it names the results"),
           first_key("kind", word_list(words), "what it is: it has the keys of that kind", words)}};
}

}  // namespace

std::string default_text(const Key& key) {
  if (key.standard.is_null()) return "";
  return key.standard == "inf" ? "inf" : to_text(key.standard);
}

std::string meaning_of(const Key& key) {
  return key.unit.empty() ? key.description : fmt::format("{} ({})", key.description, key.unit);
}

std::vector<KeyList> method_lists() {
  std::vector<KeyList> lists;
  for_each_alternative<Method>(
      [&]<class Params>(std::type_identity<Params>) { lists.push_back(method_list(Params())); });
  return lists;
}

std::vector<KeyList> preset_lists() {
  std::vector<KeyList> lists;
  for_each_alternative<Method>([&]<class Params>(std::type_identity<Params>) {
    if constexpr (HasPresets<Params>) {
      using Word = decltype(Params().preset);
      for (std::size_t i = 0; i < enum_names<Word>.size(); ++i) {
        lists.push_back(method_list(with_preset(static_cast<Word>(i))));
        lists.back().name += fmt::format(", {}", enum_names<Word>[i]);
      }
    }
  });
  return lists;
}

std::vector<KeyList> texture_lists() {
  std::vector<KeyList> lists;
  for_each_alternative<ProceduralTexture>([&]<class T>(std::type_identity<T>) {
    lists.push_back({std::string(T::name), std::string(T::summary), {}, keys_of<T>()});
  });
  return lists;
}

std::vector<KeyList> direction_lists() {
  std::vector<KeyList> lists;
  for_each_direction(Direction(), [&]<class Entry>(const std::optional<Entry>&) {
    lists.push_back({std::string(Entry::section), "", {}, keys_of<Entry>()});
  });
  return lists;
}

std::vector<KeyList> model_lists() {
  std::vector<KeyList> lists;
  for_each_alternative<ModelRecipe>([&]<class Recipe>(std::type_identity<Recipe>) {
    lists.push_back(
        {std::string(Recipe::kind), std::string(Recipe::summary), {}, keys_of<Recipe>()});
  });
  return lists;
}

std::vector<KeyList> map_lists() {
  std::vector<KeyList> lists = named_lists<SurfaceParams, PhotoParams, PreviewParams>();
  lists.back().keys = keys_of<PreviewEntry>();
  return lists;
}

std::vector<KeyList> simulation_lists() { return named_lists<SimulationParams, ClothParams>(); }

std::vector<KeyList> table_lists() {
  std::vector<KeyList> lists{
      {"", "what holds for all textures; above the first table", {}, keys_of<Config>()},
      exemplar_list(),
      kinds_list("[[method]]", "what makes textures; as many as you like", method_lists()),
      kinds_list("[[model]]", "what 'gramloom train' trains", model_lists())};
  for (KeyList& list : direction_lists()) {
    list.name = fmt::format("[{}]", list.name);
    list.summary = "directs the textures of this config";
    lists.push_back(std::move(list));
  }
  lists.push_back({"[surface]", std::string(SurfaceParams::summary), {}, keys_of<SurfaceParams>()});
  lists.push_back({"[preview]",
                   fmt::format("{}; [[preview]] where there are several", PreviewParams::summary),
                   {},
                   keys_of<PreviewEntry>()});
  lists.push_back(
      {"[baseline]", "how far a run may be from an earlier one", {}, keys_of<BaselineLimits>()});
  return lists;
}

}  // namespace gramloom
