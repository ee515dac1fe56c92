// The main function of every test program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/threads.h"

namespace gramloom {
namespace {

// In memory, where there is room: the program flushes each result to the disk, and waiting for that
// would take longer than most tests' work. TMPDIR says where else.
std::filesystem::path temp_root() {
  const std::filesystem::path memory = "/dev/shm";
  constexpr std::uintmax_t room = std::uintmax_t{2} << 30;
  std::error_code error;
  const auto space = std::filesystem::space(memory, error);
  const bool fits = !error && space.available >= room && access(memory.c_str(), W_OK | X_OK) == 0;
  return fits && !std::getenv("TMPDIR") ? memory : std::filesystem::temp_directory_path();
}

// A folder of this process alone for all temporary files, of programs that it starts too: several
// test programs run at once, and files of equal names must not meet.
class OwnTempFolder {
 public:
  OwnTempFolder() : path_((temp_root() / "gramloom-test-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) {
      std::perror(path_.c_str());
      std::exit(1);
    }
    setenv("TMPDIR", path_.c_str(), 1);
    setenv("TEST_TMPDIR", path_.c_str(), 1);  // what testing::TempDir() reads
  }
  ~OwnTempFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  OwnTempFolder(const OwnTempFolder&) = delete;
  OwnTempFolder& operator=(const OwnTempFolder&) = delete;

 private:
  std::string path_;
};

// A test that sets a number of threads leaves no trace for the next one, wherever it ends.
class AllThreadsAgain : public testing::EmptyTestEventListener {
  void OnTestEnd(const testing::TestInfo&) override { set_thread_count(0); }
};

}  // namespace
}  // namespace gramloom

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::UnitTest::GetInstance()->listeners().Append(new gramloom::AllThreadsAgain);
  const gramloom::OwnTempFolder folder;
  return RUN_ALL_TESTS();
}
