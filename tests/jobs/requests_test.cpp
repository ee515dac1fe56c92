// What methods make of the parts of a request: each is honoured or refused by name, tiny inputs
// work or are refused before the work, and copies say where they are from.
#include <gmock/gmock.h>

#include "jobs/every_method.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

template <class Params>
class Requests : public OfMethod<Params> {
 protected:
  /// What the method itself says, and what `run` and `check` say, of a request that it refuses.
  static std::string refusal(const Request& request) {
    const Params params = OfMethod<Params>::quick();
    std::string text;
    try {
      synthesise(params, request, {});
    } catch (const Error& error) {
      text = error.what();
    }
    EXPECT_THROW(estimate(params, size_of(request)), Error);
    if constexpr (std::is_constructible_v<Method, std::in_place_type_t<Params>>) {
      EXPECT_THAT([&] { run_method(Method(params), request, {}); },
                  testing::ThrowsMessage<Error>(StartsWith(text)));
      EXPECT_THAT([&] { estimate_method(Method(params), size_of(request)); },
                  testing::ThrowsMessage<Error>(HasSubstr("method")));
    }
    return text;
  }
};
TYPED_TEST_SUITE(Requests, EveryMethod, KindNames);

TYPED_TEST(Requests, WhatItLacksItRefusesByName) {
  const auto has = [](Ability ability) { return TypeParam::abilities.has(ability); };
  const Image exemplar = grain({24, 20}, 3);
  const Request plain = this->request(exemplar, {{16, 16}});
  if (!has(Ability::exemplar)) {
    Request request = plain;
    request.exemplars.push_back({exemplar});
    EXPECT_THAT(this->refusal(request), HasSubstr("takes no exemplar: one is given"));
    return;
  }
  Request none = plain;
  none.exemplars.clear();
  EXPECT_THROW(synthesise(this->quick(), none, {}), Error);
  EXPECT_THROW(estimate(this->quick(), size_of(none)), Error);
  if (!has(Ability::exemplars)) {
    Request request = plain;
    request.exemplars.push_back({exemplar});
    EXPECT_THAT(this->refusal(request), HasSubstr("takes one exemplar: 2 are given"));
  }
  if (!has(Ability::mask)) {
    Request request = plain;
    request.exemplars[0].mask = Image(exemplar.size(), 1, 1.0f);
    EXPECT_THAT(this->refusal(request), HasSubstr("an exemplar's mask is given"));
  }
  if (!has(Ability::guide)) {
    Request request = plain;
    request.exemplars[0].guide = Image(exemplar.size(), 2);
    request.target.guide = Image(request.target.size, 2);
    EXPECT_THAT(this->refusal(request), HasSubstr("cannot follow a guide: a guide is given"));
  }
  if (!has(Ability::fill)) {
    Request request = plain;
    request.target.known = Image(request.target.size, 3);
    request.target.mask = Image(request.target.size, 1, 1.0f);
    EXPECT_THAT(this->refusal(request), HasSubstr("cannot fill: a target's mask is given"));
  }
}

TYPED_TEST(Requests, RefusesPartsThatDoNotFitTogether) {
  if (!TestFixture::takes_exemplar) GTEST_SKIP() << "takes no exemplar";
  const Image exemplar = grain({24, 20}, 4);
  const auto refused = [&](std::vector<Layer> layers) {
    Request request = this->request(exemplar, {{16, 16}});
    request.exemplars[0].layers = std::move(layers);
    EXPECT_THROW(synthesise(this->quick(), request, {}), Error);
  };
  refused({{"", MapKind::colour, 0, 3}});
  refused({{"", MapKind::colour, 0, 5}});
  refused({{"", MapKind::colour, 1, 3}});
  refused({{"", MapKind::colour, 0, 3}, {"height", MapKind::scalar, 2, 2}});
  refused({{"", MapKind::colour, 0, 2}, {"normal", MapKind::normal, 2, 2}});
}

TYPED_TEST(Requests, LayersOfEveryKindKeepTheirValuesWhereWholePixelsAreCopied) {
  if (!TestFixture::copies) GTEST_SKIP() << "does not copy";
  const Image exemplar = grain({24, 20}, 8);
  Request request = this->request(exemplar, {{30, 26}});
  request.exemplars[0].layers = {{"", MapKind::colour, 0, 3},
                                 {"", MapKind::alpha, 3, 1},
                                 {"height", MapKind::scalar, 4, 1},
                                 {"normal", MapKind::normal, 5, 3}};
  const Texture texture = synthesise(this->quick(), request, {});
  EXPECT_EQ(arranged(texture.source, request.exemplars), texture.image);
}

TYPED_TEST(Requests, SourcesMakeTheTextureAgain) {
  for (const Size size : {Size{48, 40}, Size{9, 7}, Size{1, 1}, Size{1, 9}, Size{40, 2}})
    for (const Tile tile : {Tile::none, Tile::x, Tile::y, Tile::both})
      for (const Size target : {Size{70, 61}, Size{12, 30}, Size{1, 1}, Size{2, 33}}) {
        if (TestFixture::is_neural && size != Size{48, 40}) continue;
        if (TestFixture::is_neural && target != Size{70, 61}) continue;
        const Request request = this->request(grain(size, 3), {target, tile});
        const Texture texture = synthesise(this->quick(), request, {});
        ASSERT_EQ(texture.source.empty(), !TestFixture::copies);
        if (!TestFixture::copies) continue;
        ASSERT_EQ(texture.source.size, target);
        ASSERT_EQ(arranged(texture.source, request.exemplars), texture.image)
            << size.width << "×" << size.height << " to " << target.width << "×" << target.height;
      }
}

// Where two pieces blend, the source is of the piece that the pixel has more of.
TEST(QuiltingSources, OfBlendedPixelsAreThoseOfTheStrongerPiece) {
  const Request request{{{grain({48, 40}, 3)}}, {{90, 80}, Tile::both}, Random(1)};
  const Texture texture = synthesise(QuiltingParams{.patch_size = 16, .feather = 3}, request, {});
  const Image cut = arranged(texture.source, request.exemplars);
  const ChannelRange range = channel_range(request.exemplars[0].image);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < cut.pixels.size(); ++i) {
    equal += cut.pixels[i] == texture.image.pixels[i] ? 1u : 0u;
    // Pieces that meet are alike: a blend is near to the stronger one.
    EXPECT_NEAR(cut.pixels[i], texture.image.pixels[i],
                0.5f * (range.high[i % 3] - range.low[i % 3]));
  }
  EXPECT_GT(equal, cut.pixels.size() / 4);
  EXPECT_LT(equal, cut.pixels.size());
}

/// Which tiny inputs a method makes a texture of. It refuses the others before the work.
template <class Params>
bool works([[maybe_unused]] Size exemplar, [[maybe_unused]] Size target,
           [[maybe_unused]] Tile tile) {
  if constexpr (std::is_base_of_v<NeuralParams, Params>) {
    const auto& patches = Params().patch_sizes;
    const int patch = *std::max_element(patches.begin(), patches.end());
    return std::min(exemplar.width, exemplar.height) >= patch &&
           (tiles_x(tile) || target.width >= patch) && (tiles_y(tile) || target.height >= patch);
  } else {
    return true;  // from one pixel on
  }
}

TYPED_TEST(Requests, TinyInputsWorkOrAreRefusedBeforeTheWork) {
  const std::vector<Size> exemplars{{1, 1}, {1, 9}, {9, 1}, {2, 2},  {5, 3},
                                    {6, 7}, {7, 7}, {8, 9}, {40, 2}, {48, 40}};
  const std::vector<Size> targets{{1, 1}, {1, 40}, {50, 1}, {2, 30}, {3, 7}, {7, 7}, {24, 20}};
  for (const Size from : exemplars)
    for (const Size size : targets)
      for (const Tile tile : {Tile::none, Tile::x, Tile::both}) {
        SCOPED_TRACE(fmt::format("{}×{} from {}×{}, tile {}", size.width, size.height, from.width,
                                 from.height, static_cast<int>(tile)));
        const Image exemplar = grain(from, 3);
        const Request request = this->request(exemplar, {size, tile});
        if (works<TypeParam>(from, size, tile)) {
          EXPECT_NO_THROW(estimate(this->quick(), size_of(request)));
          this->expect_sound(synthesise(this->quick(), request, {}).image, exemplar, size);
        } else {
          EXPECT_THROW(estimate(this->quick(), size_of(request)), Error);
        }
      }
}

TEST(Abilities, NameTheMethodsThatCan) {
  const Request request{{{grain({16, 16}, 3)}}, {{16, 16}}, Random(1)};
  EXPECT_THAT([&] { run_method(ProceduralParams{}, request, {}); },
              testing::ThrowsMessage<Error>(
                  HasSubstr("procedural takes no exemplar: one is given; methods that can: neural, "
                            "quilting")));
}

}  // namespace
}  // namespace gramloom
