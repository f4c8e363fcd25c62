#include <gtest/gtest.h>

#include "core/base/ranks.hpp"

int main(int argc, char** argv) {
  perifrac::ranks::Session session;
  testing::InitGoogleTest(&argc, argv);
  return session.end(RUN_ALL_TESTS());
}
