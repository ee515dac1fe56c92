// The main function of every test program.
#include <gtest/gtest.h>

#include "core/threads.h"

namespace gramloom {
namespace {

// A test that sets a number of threads leaves no trace for the next one, wherever it ends.
class AllThreadsAgain : public testing::EmptyTestEventListener {
  void OnTestEnd(const testing::TestInfo&) override { set_thread_count(0); }
};

}  // namespace
}  // namespace gramloom

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::UnitTest::GetInstance()->listeners().Append(new gramloom::AllThreadsAgain);
  return RUN_ALL_TESTS();
}
