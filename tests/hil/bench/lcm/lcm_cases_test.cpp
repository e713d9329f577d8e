#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "hil/bench/case.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

class LcmCasesTest : public testing::Test {
 protected:
  /// @param fault  keys of it, one a line
  [[nodiscard]] Case load(const std::string& mission, const std::string& fault) const {
    const std::filesystem::path path = folder_ / "a.toml";
    std::ofstream(path) << "given = \"a\"\nwhen = \"b\"\nthen = \"c\"\nmission = \"" << EARSHOT_SOURCE_DIR << "/hil/missions/search_over_"
                        << mission << ".toml\"\n[[fault]]\nat_s = 1\n"
                        << fault << "\n[expect]\nend = \"found\"\n";
    return load_case(path, {});
  }
  [[nodiscard]] std::string refusal(const std::string& mission, const std::string& fault) const {
    try {
      (void)load(mission, fault);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "it was taken";
  }
  const support::TemporaryFolder folder_;
};

TEST_F(LcmCasesTest, AreOnTheBusOfTheirMissionsPorts) {
  EXPECT_EQ(load("lcm", "kind = \"loss\"\nof = \"vehicle-status\"").bus, host::PortKind::kLcm);
  EXPECT_EQ(load("can", "kind = \"loss\"\nof = \"compass\"").bus, host::PortKind::kCan);
}

TEST_F(LcmCasesTest, RefuseFaultsThatTheirBusDoesNotKnow) {
  for (const std::string kind : {"wrong_length", "second_autopilot", "address_thief", "interface_down"})
    EXPECT_NE(refusal("lcm", "kind = \"" + kind + "\"").find("there is no " + kind + " over LCM, the mission's bus"), std::string::npos);
  for (const std::string kind : {"reordering", "date_error", "navigation_flood", "unknown_order", "cut_abort", "recorded_order"})
    EXPECT_NE(refusal("can", "kind = \"" + kind + "\"").find("there is no " + kind + " over CAN, the mission's bus"), std::string::npos);
}

TEST_F(LcmCasesTest, RefuseSendersAndGroupsThatTheirBusDoesNotHave) {
  EXPECT_NE(refusal("lcm", "kind = \"loss\"\nof = \"compass\"").find("fault 1: of"), std::string::npos);
  EXPECT_NE(refusal("lcm", "kind = \"loss\"\npgn = 127250").find("fault 1: pgn: unknown key"), std::string::npos);
}

}  // namespace
}  // namespace earshot::hil
