// Small trainings gain nothing by a second thread. oneDNN's threads spin while they wait for one
// another, which takes twice the time, and more where other tests run beside.
#include <gtest/gtest.h>

#include "core/threads.h"

namespace gramloom {
namespace {

class InOneThread : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { set_thread_count(1); }
};

[[maybe_unused]] const bool added = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new InOneThread);
  return true;
}();

}  // namespace
}  // namespace gramloom
