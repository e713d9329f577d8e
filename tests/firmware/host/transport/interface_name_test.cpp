#include "firmware/host/transport/interface_name.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace earshot::host {
namespace {

using namespace std::string_view_literals;

TEST(InterfaceName, TakesWhatLinuxCallsAnInterface) {
  for (const std::string_view name : {"can0"sv, "vcan0"sv, "c"sv, "can-front.left_1"sv.substr(0, 15), "..."sv, "can%d"sv, "\xC3\xA9t"sv})
    EXPECT_TRUE(is_interface_name(name)) << name;
}

TEST(InterfaceName, RefusesWhatNoInterfaceCanBeCalled) {
  for (const std::string_view name : {""sv, "."sv, ".."sv, "a/b"sv, "a b"sv, "can0:1"sv, "x\n"sv, "\tx"sv, "x\v"sv, "x\f"sv, "x\r"sv,
                                      "a\0b"sv, "a\xC2\xA0"sv, "can-front.left_1"sv, "interface-of-a-bus-with-a-long-name"sv})
    EXPECT_FALSE(is_interface_name(name)) << name;
}

}  // namespace
}  // namespace earshot::host
