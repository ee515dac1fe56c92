#include <gtest/gtest.h>
TEST(Probe, Nothing) {}
