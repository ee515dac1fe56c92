#include "io/pictures_in_memory.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/error.h"
#include "io/toml_reader.h"

namespace gramloom {
namespace {

struct Files {
  std::filesystem::path picture;

  static constexpr auto fields() {
    return std::tuple{Field{"picture", &Files::picture, "a picture"}};
  }
};

std::filesystem::path picture_of_config() {
  const toml::table table = parse_toml("picture = 'a picture'", "config");
  Files files;
  read_fields(files, table);
  return files.picture;
}

PicturesInMemory::Pictures pictures(float value) {
  return {{"a picture", {{2, 1, 1, value}, {}, {}, {}}}};
}

TEST(PicturesInMemory, AreFoundByConfigsAndByReaders) {
  const PicturesInMemory found(pictures(0.5f));
  EXPECT_EQ(read_image(picture_of_config()).image.pixels, std::vector(2, 0.5f));
}

TEST(PicturesInMemory, AreThoseOfTheirThreadAndTheirTime) {
  {
    const PicturesInMemory outer(pictures(0.5f));
    {
      const PicturesInMemory inner(pictures(1));
      EXPECT_EQ(*read_image("a picture").image.at(0, 0), 1);
    }
    EXPECT_EQ(*read_image("a picture").image.at(0, 0), 0.5f);
    std::thread([] { EXPECT_EQ(picture_in_memory("a picture"), nullptr); }).join();
  }
  EXPECT_THROW(picture_of_config(), ConfigError);
  EXPECT_THROW(read_image("a picture"), Error);
}

}  // namespace
}  // namespace gramloom
