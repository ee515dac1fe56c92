#include "jobs/inference_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

#include "core/error.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "jobs/pose_blends.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PairsTest : public testing::Test {
 protected:
  PairsTest() : folder_(fs::temp_directory_path() / fmt::format("gramloom_pairs_{}", getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    for (int i = 0; i < 8; ++i) {
      const std::string name = fmt::format("p{}.exr", i);
      write_image(folder_ / name, Image(4, 4, 1, static_cast<float>(i)),
                  {PixelType::float32, "", {}});
      rows_.push_back(fmt::format("{},{},-1", name, i));
    }
  }
  ~PairsTest() override { fs::remove_all(folder_); }

  InferencePairs read(const std::string& columns = "picture,bend,twist") const {
    std::string text = columns + "\n";
    for (const std::string& row : rows_) text += row + "\n";
    write_text(folder_ / "t.csv", text);
    FileHashes hashes;
    return read_pairs(folder_ / "t.csv", hashes);
  }
  std::string refusal(const std::string& columns = "picture,bend,twist") const {
    try {
      read(columns);
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.find('\n'), std::string::npos);
      const std::string folder = folder_.string() + "/";
      EXPECT_EQ(text.find(folder), 0u) << text;
      return text.substr(folder.size());
    }
    return "";
  }

  const fs::path folder_;
  std::vector<std::string> rows_;
};

TEST_F(PairsTest, ReadsPosesAndPictures) {
  rows_.insert(rows_.begin() + 2, "");
  const InferencePairs pairs = read();
  ASSERT_EQ(pairs.poses.size(), 8u);
  EXPECT_EQ(pairs.poses[5], (std::vector<double>{5, -1}));
  EXPECT_EQ(pairs.pictures[5].pixels[0], 5.0f);
  EXPECT_EQ(pairs.numbers, (std::vector<PoseNumber>{{"bend", 0, 7}, {"twist", -1, -1}}));
  EXPECT_EQ(pairs.pixel_type, PixelType::float32);
  EXPECT_EQ(pairs.values, MapKind::scalar);
}

TEST_F(PairsTest, AnythingThatIsReadChangesTheHash) {
  const std::string hash = read().hash;
  EXPECT_EQ(read().hash, hash);
  rows_[1] = "p1.exr,1,-1.5";
  EXPECT_NE(read().hash, hash);
  rows_[1] = "p1.exr,1,-1";
  write_image(folder_ / "p1.exr", Image(4, 4, 1, 9), {PixelType::float32, "", {}});
  EXPECT_NE(read().hash, hash);
}

TEST_F(PairsTest, MistakesAreToldWithFileAndLine) {
  EXPECT_EQ(refusal("image,bend,twist"), "t.csv:2: image: 'p0.exr' is not a number");
  EXPECT_EQ(refusal("picture,bend,bend"), "t.csv:1: two columns are called 'bend'");
  EXPECT_EQ(refusal("picture,bend,"), "t.csv:1: column 3 has no name");
  EXPECT_EQ(refusal("picture,bend"), "t.csv:2: 3 cells, the first line has 2");
  const auto with = [&](std::size_t row, const std::string& text) {
    const std::string before = std::exchange(rows_[row], text);
    const std::string says = refusal();
    rows_[row] = before;
    return says;
  };
  EXPECT_EQ(with(3, ",3,-1"), "t.csv:5: names no picture");
  EXPECT_EQ(with(3, "\"p3.exr,3,-1"), "t.csv:5: a quote is not closed");
  EXPECT_EQ(refusal("picture;bend;twist"), "t.csv:1: cells are parted by ';', allowed is ','");
  EXPECT_EQ(refusal("\xEF\xBB\xBFpicture,bend,twist"), "") << "a spreadsheet's byte order mark";
  EXPECT_EQ(with(3, "p3.exr,x,-1"), "t.csv:5: bend: 'x' is not a number");
  EXPECT_EQ(with(3, "p3.exr,,-1"), "t.csv:5: bend: '' is not a number");
  EXPECT_EQ(with(3, "p3.exr,nan,-1"), "t.csv:5: bend: 'nan' is not a finite number");
  EXPECT_THAT(with(3, "q.exr,3,-1"), HasSubstr("t.csv:5: "));
  rows_.insert(rows_.begin(), "\"p0\n.exr\",0,-1");
  EXPECT_EQ(with(4, "p3.exr,x,-1"), "t.csv:7: bend: 'x' is not a number")
      << "after two lines of one row";
  rows_.erase(rows_.begin());
  EXPECT_THAT(with(3, "q.exr,3,-1"), HasSubstr("q.exr"));
  write_image(folder_ / "wide.exr", Image(8, 4, 1, 1), {PixelType::float32, "", {}});
  EXPECT_THAT(with(3, "wide.exr,3,-1"),
              HasSubstr("is of 8×4 with 1 channels, the first picture of 4×4 with 1"));
  rows_.pop_back();
  EXPECT_EQ(refusal(), "t.csv: has 7 pairs, needed are 8 at least");
  rows_ = {"1,2", "3,4"};
  EXPECT_EQ(refusal("bend,twist"), "t.csv:1: has no column 'picture'");
  rows_ = {"p1.exr"};
  EXPECT_EQ(refusal("picture"), "t.csv:1: has no column of numbers");
}

TEST(PairSplit, IsEvenAndDisjoint) {
  for (const std::size_t count : {8u, 9u, 240u})
    for (const double share : {0.01, 0.15, 0.5}) {
      const PairSplit split = split_pairs(count, share, 3);
      std::set<std::size_t> all;
      for (const auto* part : {&split.learnt, &split.chosen_by, &split.tested})
        all.insert(part->begin(), part->end());
      EXPECT_EQ(all.size(), count);
      EXPECT_EQ(split.learnt.size() + split.chosen_by.size() + split.tested.size(), count);
      EXPECT_GE(split.tested.size(), 1u);
      EXPECT_LE(split.chosen_by.size() - split.tested.size(), 1u);
      EXPECT_GE(split.learnt.size(), count / 2);
    }
  const PairSplit split = split_pairs(240, 0.15, 1);
  EXPECT_EQ(split.tested.size(), 18u);
  // Each in its stretch of the table.
  const auto expect_in_stretch = [](std::size_t pair, std::size_t stretch) {
    EXPECT_GE(pair, stretch * 240 / 36);
    EXPECT_LT(pair, (stretch + 1) * 240 / 36);
  };
  for (std::size_t i = 0; i < 18; ++i) {
    expect_in_stretch(split.chosen_by[i], 2 * i);
    expect_in_stretch(split.tested[i], 2 * i + 1);
  }
  EXPECT_NE(split_pairs(240, 0.15, 2).tested, split.tested);
}

// Pictures that depend linearly on the pose, at random poses.
InferencePairs linear_pairs(int count, std::uint64_t seed) {
  InferencePairs pairs;
  pairs.numbers = {{"a", 0, 1}, {"b", 0, 10}};
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const double a = static_cast<double>(random.uniform());
    const double b = 10 * static_cast<double>(random.uniform());
    pairs.poses.push_back({a, b});
    Image picture(2, 1, 1);
    picture.pixels = {static_cast<float>(a + 0.3 * b), static_cast<float>(1 - 2 * a)};
    pairs.pictures.push_back(picture);
  }
  return pairs;
}

TEST(PoseBlends, ALinearFitIsExactWhereAllIsLinear) {
  const InferencePairs pairs = linear_pairs(30, 1), others = linear_pairs(10, 2);
  const Image mean = mean_picture(pairs.pictures);
  const PoseBlend best = best_blend(pairs, others);
  EXPECT_TRUE(best.linear) << best.text();
  std::vector<Image> fit, nearest, away;
  for (const auto& pose : others.poses) {
    fit.push_back(blended_picture(pairs, best, pose));
    nearest.push_back(nearest_picture(pairs, pose));
    away.push_back(mean);
  }
  EXPECT_LT(relative_error(fit, others.pictures, mean), 1e-3);
  EXPECT_GT(relative_error(nearest, others.pictures, mean), 0.05);
  EXPECT_DOUBLE_EQ(relative_error(away, others.pictures, mean), 1);
  EXPECT_EQ(relative_error(others.pictures, others.pictures, mean), 0);
}

TEST(PoseBlends, AtAPoseThatWasLearntItsPictureIsAllThatCounts) {
  const InferencePairs pairs = linear_pairs(30, 1);
  EXPECT_EQ(nearest_picture(pairs, pairs.poses[7]), pairs.pictures[7]);
  const Image blend = blended_picture(pairs, {8, 2, false}, pairs.poses[7]);
  EXPECT_NEAR(blend.pixels[0], pairs.pictures[7].pixels[0], 1e-4);
}

}  // namespace
}  // namespace gramloom
