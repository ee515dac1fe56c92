#include "io/text_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <map>
#include <thread>
#include <vector>

#include "core/random.h"
#include "io/image_file.h"
#include "io/image_rows.h"
#include "io/safetensors.h"
#include "io/temp_folder.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using TextFile = TempFolder;

/// The Error of `action` while no file can grow beyond `bytes`, as on a full disk.
std::string error_on_full_disk(rlim_t bytes, const std::function<void()>& action) {
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const rlimit limit{bytes, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string error = error_of(action);
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  return error;
}

TEST_F(TextFile, RoundTripKeepsEveryByte) {
  std::string bytes;
  for (int i = 0; i < 3'000'000; ++i) bytes.push_back(static_cast<char>((i * 79) >> 5));
  for (const auto& text : {std::string(), std::string("line\n"), std::string(1, '\0'), bytes}) {
    write_text(path("a"), text);
    EXPECT_TRUE(read_text(path("a")) == text);
  }
  EXPECT_EQ(file_count(), 1);
}

TEST_F(TextFile, NamesOfAnyLengthAndLetters) {
  for (const auto& name : {std::string("ü ä?.png"), std::string(255, 'x')}) {
    write_text(path(name), "text");
    EXPECT_EQ(read_text(path(name)), "text");
  }
  EXPECT_THAT(error_of([&] { write_text(path(std::string(256, 'x')), ""); }),
              HasSubstr("name too long"));
}

TEST_F(TextFile, ErrorsNameThePathAndTheReason) {
  const std::string folder = path().string();
  EXPECT_EQ(error_of([&] { read_text(path("none")); }),
            folder + "/none: cannot read: No such file or directory");
  EXPECT_EQ(error_of([&] { read_text(path()); }), folder + ": cannot read: Is a directory");
  EXPECT_EQ(error_of([&] { write_text(path(), ""); }), folder + ": cannot write: Is a directory");
  EXPECT_EQ(error_of([&] { write_text(path("none/a"), ""); }),
            folder + "/none/a: cannot write: No such file or directory");
  write_text(path("file"), "");
  EXPECT_EQ(error_of([&] { write_text(path("file/a"), ""); }),
            folder + "/file/a: cannot write: Not a directory");
}

TEST_F(TextFile, FoldersThatMayNotBeWritten) {
  EXPECT_THAT(error_of([] { write_text("/proc/gramloom", ""); }),
              HasSubstr("/proc/gramloom: cannot write: "));
  if (geteuid() == 0) GTEST_SKIP() << "root may write in every other folder";
  using std::filesystem::perms;
  std::filesystem::permissions(path(), perms::owner_read | perms::owner_exec);
  EXPECT_THAT(error_of([&] { write_text(path("a"), ""); }), HasSubstr("Permission denied"));
  std::filesystem::permissions(path(), perms::owner_all);
}

TEST_F(TextFile, DevicesAreWrittenDirectly) {
  EXPECT_EQ(error_of([] { write_text("/dev/full", "text"); }),
            "/dev/full: cannot write: No space left on device");
  write_text("/dev/null", "text");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(TextFile, AFullDiskLeavesTheOldFileAndNothingElse) {
  Image image(64, 64, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>((i * 2654435761u) >> 8 & 255) / 255.0f;
  const TensorData tensor{{64, 64, 3}, image.pixels};

  std::map<std::string, std::function<void(const std::filesystem::path&)>> writers{
      {"a.txt", [](const auto& to) { write_text(to, std::string(100'000, 'x')); }},
      {"a.safetensors", [&](const auto& to) {
         write_tensors(to, {{"t", tensor}});
       }}};
  for (const auto* ending : {"png", "jpg", "tif", "exr", "tga", "bmp", "ppm", "hdr"})
    writers.emplace(fmt::format("a.{}", ending),
                    [&](const auto& to) { write_image(to, image, {}); });
  for (const auto& [name, write] : writers) {
    write_text(path(name), "old");
    EXPECT_EQ(error_on_full_disk(500, [&] { write(path(name)); }),
              path(name).string() + ": cannot write: File too large");
    EXPECT_EQ(read_text(path(name)), "old");
  }
  EXPECT_EQ(file_count(), static_cast<std::ptrdiff_t>(writers.size()));
}

// More than is kept back before it is sent: the disk is full between two pieces of the picture.
TEST_F(TextFile, ADiskThatFillsInTheMiddleOfAPicture) {
  Image image(900, 900, 3);
  Random random(1);
  for (float& value : image.pixels) value = random.uniform();
  for (const auto* ending : {"png", "jpg", "tif", "exr", "tga", "bmp", "ppm", "hdr"}) {
    const auto to = path(fmt::format("a.{}", ending));
    EXPECT_EQ(error_on_full_disk(500'000,
                                 [&] {
                                   const auto rows = open_image_rows(to, image.size(), 3, {});
                                   for (int y = 0; y < image.height; y += 450)
                                     rows->write(image.at(0, y), 450);
                                   rows->finish();
                                 }),
              to.string() + ": cannot write: File too large");
  }
  EXPECT_EQ(file_count(), 0);
}

TEST_F(TextFile, WritersAtOnceLeaveOneCompleteFile) {
  write_text(path("a"), std::string(100'000, 'z'));
  std::vector<std::thread> writers;
  for (char letter = 'a'; letter < 'i'; ++letter)
    writers.emplace_back([this, letter] {
      for (int i = 0; i < 10; ++i) write_text(path("a"), std::string(100'000, letter));
    });
  for (int i = 0; i < 20; ++i) {
    const std::string text = read_text(path("a"));
    EXPECT_TRUE(text == std::string(100'000, text.front()));
  }
  for (auto& writer : writers) writer.join();
  EXPECT_EQ(file_count(), 1);
}

}  // namespace
}  // namespace gramloom
