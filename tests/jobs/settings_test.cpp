#include "jobs/settings.h"

#include <gtest/gtest.h>

#include "core/variants.h"
#include "io/toml_reader.h"
#include "jobs/listing.h"
#include "jobs/method_reader.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

// JSON values of settings are TOML values too, but for the quotes around infinity.
std::string to_toml(const Json& settings) {
  std::string text;
  for (const auto& [key, value] : settings.items())
    text += fmt::format("{} = {}\n", key, value == "inf" ? "inf" : value.dump());
  return text;
}

// Every method with its defaults, and every procedural texture.
std::vector<Method> every_method() {
  std::vector<Method> methods;
  for_each_alternative<Method>([&]<class Params>(std::type_identity<Params>) {
    if constexpr (HasVariant<Params>)
      for_each_alternative<decltype(Params::texture)>([&]<class T>(std::type_identity<T>) {
        Params params;
        params.texture = T{};
        methods.push_back(params);
      });
    else
      methods.push_back(Params{});
  });
  return methods;
}

TEST(Settings, SavedSettingsReadAsTheSameMethod) {
  for (const Method& method : every_method()) {
    const Json settings = method_to_json(method, ".");
    SCOPED_TRACE(settings.dump());
    const Method read = read_method(parse_toml(to_toml(settings), "settings"));
    EXPECT_EQ(method_to_json(read, "."), settings);
  }
}

TEST(Settings, DefaultsAreInTheirRanges) {
  for (const Method& method : every_method())
    std::visit([](const auto& params) { EXPECT_NO_THROW(check_fields(params)); }, method);
}

TEST(Settings, ListNamesEveryParameter) {
  const std::string text = list_methods() + list_patterns();
  for (const Method& method : every_method()) {
    EXPECT_NE(text.find(kind_of(method)), std::string::npos);
    const Json settings = method_to_json(method, ".");
    for (const auto& [key, value] : settings.items())
      EXPECT_TRUE(key == "kind" || text.find("  " + key + " ") != std::string::npos) << key;
  }
}

TEST(Settings, PathsAreRelativeToTheConfig) {
  EXPECT_EQ(value_to_json(fs::path("configs/../models/a.toml"), fs::path("configs")),
            "../models/a.toml");
  EXPECT_EQ(value_to_json(fs::absolute("models/a.toml"), fs::path("configs")), "../models/a.toml");
  EXPECT_EQ(value_to_json(fs::path("models/a.toml"), fs::absolute("configs")), "../models/a.toml");
  EXPECT_EQ(value_to_json(fs::path("photo"), fs::path("configs")), "../photo");
  EXPECT_EQ(value_to_json(FileOrName("multiscale"), fs::path("configs")), "multiscale");
  EXPECT_EQ(value_to_json(FileOrName("a.toml"), fs::path("configs")), "../a.toml");
  EXPECT_EQ(value_to_json(fs::path(), fs::path("configs")), "");
}

}  // namespace
}  // namespace gramloom
