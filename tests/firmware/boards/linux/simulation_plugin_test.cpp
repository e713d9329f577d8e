#include "firmware/boards/linux/simulation_plugin.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::board {
namespace {

TEST(OpenSimulation, SaysWhereItLookedWhereNoSimulationIsInstalled) {  // as in the folder of the tests
  try {
    (void)open_simulation({.domain = 3});
    FAIL() << "opened one";
  } catch (const host::BadInput& e) {
    const std::string said = e.what();
    EXPECT_EQ(said.find("--simulation: there is no libearshot-simulation.so in /"), 0U) << said;
    EXPECT_NE(said.find(" or its ../lib/earshot: the simulation is not installed here"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace earshot::board
