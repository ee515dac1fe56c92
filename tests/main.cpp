// The main function of every test program.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/threads.h"

namespace gramloom {
namespace {

// A folder of this process alone for all temporary files, of programs that it starts too: several
// test programs run at once, and files of equal names must not meet.
class OwnTempFolder {
 public:
  OwnTempFolder()
      : path_((std::filesystem::temp_directory_path() / "gramloom-test-XXXXXX").string()) {
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
