#include "jobs/method_reader.h"

#include "core/variants.h"
#include "io/toml_reader.h"

namespace gramloom {

namespace {

template <class Params>
void choose_texture(Params& params, const toml::table& table) {
  using Textures = decltype(params.texture);
  with_alternative<Textures>(read_alternative<Textures>(table, Params::variant_key),
                             [&]<class T>(std::type_identity<T>) { params.texture = T{}; });
}

// The method of `table` with the defaults of its kind, its sub-method chosen.
Method default_method(const toml::table& table) {
  std::vector<std::string> kinds;
  for_each_alternative<Method>(
      [&]<class T>(std::type_identity<T>) { kinds.emplace_back(T::kind); });
  const std::size_t kind =
      index_of_word(required_text(table, "kind"), kinds, "kind", key_region(table, "kind"));
  Method method;
  with_alternative<Method>(kind, [&]<class Params>(std::type_identity<Params>) {
    Params params;
    if constexpr (HasPresets<Params>) {
      read_fields_if(params, table, [](std::string_view name) { return name == "preset"; });
      params = with_preset(params.preset);
    }
    if constexpr (HasVariant<Params>) choose_texture(params, table);
    method = params;
  });
  return method;
}

std::vector<std::string> keys_of(const Method& method) {
  std::vector<std::string> keys{"name", "kind"};
  std::visit(
      [&]<class Params>(const Params& params) {
        if constexpr (HasVariant<Params>) keys.emplace_back(Params::variant_key);
        for_each_parameter(params,
                           [&](const auto& field, const auto&) { keys.emplace_back(field.name); });
      },
      method);
  return keys;
}

}  // namespace

Method read_method(const toml::table& table) {
  Method method = default_method(table);
  check_keys(table, keys_of(method));
  std::visit(
      [&]<class Params>(Params& params) {
        read_fields(params, table);
        if constexpr (HasVariant<Params>)
          std::visit([&](auto& texture) { read_fields(texture, table); }, params.texture);
      },
      method);
  return method;
}

Method method_of(const std::string& kind, const std::string& texture,
                 const std::vector<std::string>& set) {
  toml::table table;
  table.insert_or_assign("kind", kind);
  table.insert_or_assign("name", kind);
  for (const std::string& option : set) {
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos || equals == 0)
      throw ConfigError("--set {}: must be key=value", option);
    const std::string key = option.substr(0, equals);
    toml::table given = parse_override(key, option.substr(equals + 1), option);
    table.insert_or_assign(given.begin()->first, std::move(given.begin()->second));
  }
  if (!texture.empty()) {
    toml::table chosen = parse_override("texture", texture, "texture=" + texture);
    table.insert_or_assign("texture", std::move(*chosen.get("texture")));
  }
  return read_method(table);
}

std::vector<std::string> method_keys(const toml::table& table) {
  try {
    return keys_of(default_method(table));
  } catch (const ConfigError&) {
    return {};
  }
}

}  // namespace gramloom
