#include "signal/fill_windows.h"

#include <gtest/gtest.h>

#include "classic/pixel.h"
#include "classic/quilting.h"
#include "core/error.h"
#include "core/threads.h"
#include "directed_requests.h"

namespace gramloom {
namespace {

/// Two holes far from each other in a large picture.
Image two_holes(Size size) {
  Image hole = rectangle(size, 40, 30, 14, 12, 1);
  for (int y = 390; y < 400; ++y)
    for (int x = 580; x < 600; ++x) *hole.at(x, y) = 1;
  return hole;
}

TEST(FillWindows, HolesThatAreFarApartAreFilledByThemselves) {
  const Image picture = bricks(600, 400);
  const Image hole = two_holes({600, 400});
  const Request request = fill_request(picture, hole);
  const std::vector<FillWindow> windows = fill_windows(request, 0.7);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_EQ(windows[0].made.size(), 14u * 12u);
  EXPECT_EQ(windows[0].left, 0);
  EXPECT_EQ(windows[0].size, (Size{54 + 128, 42 + 128}));
  EXPECT_EQ(windows[1].left, 580 - 128);
  for (const int threads : {1, 4}) {
    set_thread_count(threads);
    for (const Texture& texture :
         {synthesise(QuiltingParams{}, request, {}), synthesise(PixelParams{}, request, {})}) {
      EXPECT_EQ(texture.image, picture);
      EXPECT_EQ(masked_sources(texture, request), 0);
      EXPECT_EQ(arranged(texture.source, {{picture}}), picture);
    }
  }
  set_thread_count(0);
}

TEST(FillWindows, OtherPicturesAndEdgesThatMeetAreFilledAsAWhole) {
  Request request = fill_request(bricks(600, 400), two_holes({600, 400}));
  request.target.tile = Tile::x;
  EXPECT_TRUE(fill_windows(request, 0.7).empty());
  request.target.tile = Tile::none;
  request.target.known.pixels.front() += 0.1f;
  EXPECT_FALSE(same_picture(request));
  EXPECT_TRUE(fill_windows(request, 0.7).empty());
}

TEST(FillWindows, StopsWhenAsked) {
  const Request request = fill_request(bricks(600, 400), two_holes({600, 400}));
  Control control;
  control.progress = [](const Progress&) { return false; };
  EXPECT_THROW(synthesise(QuiltingParams{}, request, control), Interrupted);
}

}  // namespace
}  // namespace gramloom
