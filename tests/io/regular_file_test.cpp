#include "io/regular_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <thread>

#include "io/image_file.h"
#include "io/quiet_stderr.h"
#include "io/safetensors.h"
#include "io/temp_folder.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using RegularFiles = TempFolder;

TEST_F(RegularFiles, PipesAndDevicesAreNoPicturesNorTensorsAndNobodyWaits) {
  mkfifo(path("pipe.png").c_str(), 0600);
  const std::vector<std::pair<std::filesystem::path, std::string>> files{
      {path("pipe.png"), "it is a pipe, not a file"},
      {"/dev/zero", "it is a device, not a file"},
      {"/dev/null", "it is a device, not a file"},
      {path(), "Is a directory"},
      {path("none"), "No such file or directory"}};
  for (const auto& [file, why] : files) {
    const std::string expected = file.string() + ": cannot read: " + why;
    EXPECT_EQ(error_of([&] { read_image(file); }), expected);
    EXPECT_EQ(error_of([&] { read_tensors(file); }), expected);
  }
}

TEST_F(RegularFiles, TextsMayComeFromPipesButNobodyWaitsForAWriter) {
  mkfifo(path("pipe").c_str(), 0600);
  EXPECT_EQ(read_text(path("pipe")), "");
  EXPECT_EQ(read_text("/dev/null"), "");
  EXPECT_EQ(error_of([] { read_text("/dev/zero"); }),
            "/dev/zero: cannot read: it is a device, not a file");
  EXPECT_THAT(error_of([&] { write_text(path("pipe"), "text"); }), HasSubstr("pipe: cannot write"));

  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const auto name = [&](int end) { return fmt::format("/proc/self/fd/{}", ends[end]); };
  const std::string text(3'000'000, 'x');  // more than a pipe holds
  std::thread writer([&] {
    write_text(name(1), text);
    close(ends[1]);
  });
  EXPECT_TRUE(read_text(name(0)) == text);
  writer.join();
  close(ends[0]);
}

TEST_F(RegularFiles, WhatLibrariesPrintIsNotSeen) {
  testing::internal::CaptureStderr();
  {
    const QuietStderr quiet;
    const QuietStderr another;
    std::fputs("libpng warning\n", stderr);
  }
  std::fputs("ours\n", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "ours\n");
}

TEST_F(RegularFiles, NamesAreJustNames) {
  Image image(5, 4, 3, 0.2f);
  for (const std::string folder : {"why?", "a#b=c", "[x] {y} %d", "caf\xe9", "木目"})
    for (const std::string name :
         {"a?b=c", "#1", "a%04d", "[0-9]*", "\xff\xfe", "木目", "a:b", "-"})
      for (const std::string extension : {".png", ".tif", ".exr", ".jpg", ".tga", ".ppm"}) {
        std::filesystem::create_directories(path(folder));
        const auto file = path(folder) / (name + extension);
        write_image(file, image, {});
        EXPECT_EQ(read_image(file).image.size(), image.size()) << file;
      }
  write_image(path("a.png"), image, {});
  for (const std::string name : {"a.png?x=1", "a.p?g", "a."}) {
    std::filesystem::copy_file(path("a.png"), path(name));
    EXPECT_EQ(read_image(path(name)).image, image) << name;
    EXPECT_THAT(error_of([&] { write_image(path("b" + name), image, {}); }),
                HasSubstr("extension"));
  }
}

}  // namespace
}  // namespace gramloom
