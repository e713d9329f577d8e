#include "firmware/boards/linux/simulation_plugin.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

TEST(OpenSimulation, SaysWhereItLookedWhereNoSimulationIsInstalled) {  // as in the folder of the tests
  try {
    (void)open_simulation({.domain = 3});
    FAIL() << "opened one";
  } catch (const host::BadInput& e) {
    const std::string said = e.what();
    EXPECT_TRUE(support::tells(said, {"--simulation", "no libearshot-simulation.so"})) << said;
    EXPECT_TRUE(support::has_line(said, {"earshot", "simulation", "not installed"})) << said;
  }
}

}  // namespace
}  // namespace earshot::board
