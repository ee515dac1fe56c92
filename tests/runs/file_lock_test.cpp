#include "runs/file_lock.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using Mode = FileLock::Mode;

class FileLockTest : public testing::Test {
 protected:
  FileLockTest() { fs::remove(path_); }
  ~FileLockTest() override { fs::remove(path_); }

  const fs::path path_ = fs::path(testing::TempDir()) / fmt::format("lock_{}.lock", getpid());
};

TEST_F(FileLockTest, ExclusiveKeepsAllOthersOutUntilItEnds) {
  {
    const auto lock = FileLock::take(path_, Mode::exclusive);
    ASSERT_TRUE(lock);
    EXPECT_FALSE(FileLock::take(path_, Mode::exclusive));
    EXPECT_FALSE(FileLock::take(path_, Mode::shared));
    EXPECT_TRUE(fs::exists(path_)) << "a lock that was not given does not remove the file";
  }
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_TRUE(FileLock::take(path_, Mode::exclusive));
}

TEST_F(FileLockTest, SharedAdmitsSharedAndTheLastRemovesTheFile) {
  auto first = FileLock::take(path_, Mode::exclusive);
  ASSERT_TRUE(first && first->share());
  auto second = FileLock::take(path_, Mode::shared);
  ASSERT_TRUE(second);
  EXPECT_FALSE(FileLock::take(path_, Mode::exclusive));
  first.reset();
  EXPECT_TRUE(fs::exists(path_));
  EXPECT_FALSE(FileLock::take(path_, Mode::exclusive));
  second.reset();
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(FileLockTest, TheFileSaysWhoHoldsIt) {
  const auto lock = FileLock::take(path_, Mode::exclusive);
  EXPECT_TRUE(holder_of(path_).starts_with(fmt::format("process {} on ", getpid())))
      << holder_of(path_);
  EXPECT_TRUE(is_lock(path_));
}

TEST_F(FileLockTest, WhatTheDeadLeftIsTaken) {
  write_text(path_, "held by gramloom, process 1 on elsewhere\n");
  const auto lock = FileLock::take(path_, Mode::exclusive);
  ASSERT_TRUE(lock);
  EXPECT_TRUE(holder_of(path_).starts_with(fmt::format("process {} on ", getpid())));
}

TEST_F(FileLockTest, AnothersFileStaysAsItIs) {
  write_text(path_, "mine\n");
  EXPECT_FALSE(is_lock(path_));
  FileLock::take(path_, Mode::exclusive);
  EXPECT_EQ(read_text(path_), "mine\n");
}

TEST_F(FileLockTest, WhereNothingCanBeWrittenThereIsAnError) {
  try {
    FileLock::take("/nowhere/at/all.lock", Mode::exclusive);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "/nowhere/at/all.lock: cannot write: No such file or directory");
  }
}

}  // namespace
}  // namespace gramloom
