#include "io/image_rows.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "core/random.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class ImageRowsFile : public testing::Test {
 protected:
  ImageRowsFile() : folder_(fs::temp_directory_path() / fmt::format("gramloom_rows_{}", getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ImageRowsFile() override { fs::remove_all(folder_); }

  static Image noise(Size size, int channels) {
    Image image(size, channels);
    Random random(1);
    for (float& value : image.pixels) value = random.uniform();
    return image;
  }
  std::vector<std::string> write(const std::string& name, const Image& image,
                                 const Encoding& encoding, int rows_at_once) const {
    const auto rows =
        open_image_rows(folder_ / name, image.size(), image.channels, encoding, {{"a", "b"}});
    for (int y = 0; y < image.height; y += rows_at_once)
      rows->write(image.at(0, y), std::min(rows_at_once, image.height - y));
    return rows->finish();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const fs::path folder_;
};

TEST_F(ImageRowsFile, RowByRowIsTheSameFileAsAtOnce) {
  const Image image = noise({37, 50}, 3);
  for (const std::string extension : {".png", ".tif", ".exr", ".jpg", ".bmp"})
    for (const PixelType type : {PixelType::uint8, PixelType::uint16, PixelType::half}) {
      const Encoding encoding{type, "", {}};
      const auto notes =
          write_image(folder_ / ("whole" + extension), image, encoding, {{"a", "b"}});
      for (const int rows : {1, 7, 64}) {
        EXPECT_EQ(write("rows" + extension, image, encoding, rows), notes);
        const ImageFile whole = read_image(folder_ / ("whole" + extension));
        const ImageFile by_rows = read_image(folder_ / ("rows" + extension));
        EXPECT_EQ(by_rows.image, whole.image) << extension << ", " << rows << " rows";
        EXPECT_EQ(by_rows.encoding, whole.encoding);
        EXPECT_EQ(by_rows.metadata, whole.metadata);
      }
    }
}

// One that was left behind would tell how long the writing took: OpenImageIO writes it anew every
// few seconds.
TEST_F(ImageRowsFile, ATiffHasOneDirectory) {
  for (const char* colour_space : {"", "sRGB", "Linear"}) {
    write("a.tif", noise({300, 500}, 3), {PixelType::uint8, colour_space, {}}, 64);
    EXPECT_EQ(read_text(folder_ / "a.tif").substr(0, 8), std::string("II*\0\10\0\0\0", 8))
        << "at byte 8, where it was begun";
  }
}

TEST_F(ImageRowsFile, AppearsCompleteOrNotAtAll) {
  write_text(folder_ / "a.png", "of before");
  const Image image = noise({8, 20}, 3);
  {
    const auto rows = open_image_rows(folder_ / "a.png", image.size(), 3, {});
    rows->write(image.at(0, 0), 10);
    EXPECT_EQ(read_text(folder_ / "a.png"), "of before");
  }
  EXPECT_EQ(read_text(folder_ / "a.png"), "of before");
  EXPECT_EQ(files(), 1u) << "the temporary file is gone";
  write("a.png", image, {}, 5);
  EXPECT_EQ(read_image(folder_ / "a.png").image.size(), image.size());
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageRowsFile, SaysWhatWasClampedAndWhatWasNotFinite) {
  Image image = noise({8, 8}, 1);
  image.pixels[20] = 3;
  image.pixels[40] = -1;
  EXPECT_THAT(write("a.png", image, {}, 3),
              testing::ElementsAre(HasSubstr("3.12 % of the values, which reach from -1 to 3")));
  image.pixels[20] = std::nanf("");
  EXPECT_THAT(
      [&] { write("a.png", image, {}, 3); },
      testing::ThrowsMessage<Error>(HasSubstr("a.png: the value at x 4, y 2, channel 0 is nan")));
}

TEST_F(ImageRowsFile, SaysThatAlphaIsUnusual) {
  Image image(8, 8, 4, 1.0f);
  const Encoding premultiplied{PixelType::uint8, "", {"R", "G", "B", "A"}, true};
  EXPECT_THAT(write("a.png", image, premultiplied, 3), IsEmpty());
  image.at(3, 7)[3] = 0.5f;
  EXPECT_THAT(
      write("a.png", image, premultiplied, 3),
      testing::ElementsAre("colours are multiplied by alpha, which is unusual in a png file"));
  EXPECT_THAT(write("a.tif", image, premultiplied, 3), IsEmpty());
}

// A pipe has no earlier place to go back to, so its file is made in memory.
TEST_F(ImageRowsFile, APipeGetsTheBytesOfTheFile) {
  const Image image = noise({37, 70}, 3);
  for (const std::string extension :
       {".png", ".tif", ".exr", ".jpg", ".bmp", ".tga", ".ppm", ".hdr"})
    for (const PixelType type : {PixelType::uint8, PixelType::uint16, PixelType::half}) {
      const Encoding encoding{type, "", {}};
      const auto notes = write_image(folder_ / ("file" + extension), image, encoding, {{"a", "b"}});
      const fs::path pipe = folder_ / ("pipe" + extension);
      ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
      const int end = open(pipe.c_str(), O_RDWR | O_NONBLOCK);  // it holds 64 kB
      const auto pipe_notes = write_image(pipe, image, encoding, {{"a", "b"}});
      std::string bytes(1 << 16, '\0');
      bytes.resize(
          static_cast<std::size_t>(std::max<ssize_t>(read(end, bytes.data(), bytes.size()), 0)));
      close(end);
      EXPECT_TRUE(bytes == read_text(folder_ / ("file" + extension))) << extension;
      EXPECT_EQ(pipe_notes, notes);
      fs::remove(pipe);
    }
}

TEST_F(ImageRowsFile, RefusesWithThePath) {
  const auto open = [&](const fs::path& file, int channels) {
    return [this, file, channels] { open_image_rows(folder_ / file, {8, 8}, channels, {}); };
  };
  EXPECT_THAT(open("a.xyz", 3), testing::ThrowsMessage<Error>(HasSubstr("extension '.xyz'")));
  EXPECT_THAT(open("a.png", 5), testing::ThrowsMessage<Error>(HasSubstr("a.png: a png file")));
  EXPECT_THAT(open("none/a.png", 3), testing::ThrowsMessage<Error>(HasSubstr("none/a.png")));
  EXPECT_THAT(open("/dev/null", 3), testing::ThrowsMessage<Error>(HasSubstr("/dev/null")));
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace gramloom
