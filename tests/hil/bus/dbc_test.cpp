#include "hil/bus/dbc.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace earshot::hil {
namespace {

TEST(Dbc, DescribesVesselHeadingAsTheStandardDoes) {
  std::ostringstream out;
  print_dbc(out);
  const std::string dbc = out.str();
  // 127250 = 0x1F112 at priority 2 from 0x23: 0x09F11223 with DBC's extended bit: 0x89F11223 = 2314277411.
  EXPECT_NE(dbc.find("\nBO_ 2314277411 VesselHeading: 8 Vehicle\n"), std::string::npos);
  EXPECT_NE(dbc.find("\n SG_ Heading : 8|16@1+ (0.0001,0) [0|6.28318530717959] \"rad\" Earshot\n"), std::string::npos);
  EXPECT_NE(dbc.find("\n SG_ Deviation : 24|16@1- "), std::string::npos);
}

}  // namespace
}  // namespace earshot::hil
