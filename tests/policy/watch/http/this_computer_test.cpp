#include "policy/watch/http/this_computer.hpp"

#include <gtest/gtest.h>

namespace earshot::watch {
namespace {

TEST(ThisComputer, IsNamedByItsLoopbackNamesWithOrWithoutAPort) {
  for (const char* host : {"localhost", "localhost:8765", "127.0.0.1", "127.0.0.1:1", "[::1]", "[::1]:80"})
    EXPECT_TRUE(is_this_computer(host)) << host;
}

TEST(ThisComputer, IsNotNamedByWhatOthersMayCallThemselves) {
  for (const char* host : {"", "localhost.example.org", "127.0.0.1.example.org", "127.0.0.1:", "localhost:80x", "localhost:80@example.org",
                           "example.org", "10.0.0.1", "::1"})
    EXPECT_FALSE(is_this_computer(host)) << host;
}

}  // namespace
}  // namespace earshot::watch
