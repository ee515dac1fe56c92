#include "core/hash.h"

#include <gtest/gtest.h>

namespace gramloom {
namespace {

TEST(Hash, IsFnv1a) {
  // Published test vectors of FNV-1a, 64 bits.
  EXPECT_EQ(hash_of(""), "cbf29ce484222325");
  EXPECT_EQ(hash_of("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(hash_of("foobar"), "85944171f73967e8");
}

TEST(Hash, OfPiecesIsThatOfTheWhole) {
  Fnv1a hash;
  hash.add("foo");
  hash.add("bar", 3);
  EXPECT_EQ(hash.text(), hash_of("foobar"));
}

}  // namespace
}  // namespace gramloom
