#include "sim/netcdf/apart.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace earshot::netcdf {
namespace {

constexpr ApartLimits kLimits{};

TEST(NetcdfApart, TellsNothingOfWorkThatIsDoneAndHandsItsBytesOver) {
  const SharedBytes shared(sizeof(double));
  auto* const value = static_cast<double*>(shared.data());
  ASSERT_NE(value, nullptr);
  double own = 1.0;
  EXPECT_EQ(run_apart(kLimits, [&] { own = *value = 42.0; }), std::nullopt);
  EXPECT_EQ(*value, 42.0);
  EXPECT_EQ(own, 1.0);
}

TEST(NetcdfApart, SurvivesACrashAndNamesItsSignal) {
  const std::optional<std::string> end = run_apart(kLimits, [] { (void)std::raise(SIGSEGV); });
  EXPECT_EQ(end, "signal 11 (Segmentation fault)");
}

TEST(NetcdfApart, EndsWhatWorksWithoutEnd) {
  const std::optional<std::string> end = run_apart({.processor_time_s = 1}, [] {
    std::atomic<bool> goes_on = true;
    while (goes_on) {
    }
  });
  EXPECT_EQ(end, "no end after 1 s of processor time");
}

TEST(NetcdfApart, TellsOfWorkThatThrows) {
  EXPECT_EQ(run_apart(kLimits, [] { throw std::runtime_error("damaged"); }), "status 1");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(NetcdfApart, GivesNoMoreMemoryThanItsLimit) {
  constexpr std::size_t kLimit = std::size_t{64} << 20U;
  const auto take = [](std::size_t bytes) { return [bytes] { std::vector<char>(bytes).back() = 1; }; };
  EXPECT_EQ(run_apart({.more_memory = kLimit}, take(kLimit / 2)), std::nullopt);
  EXPECT_EQ(run_apart({.more_memory = kLimit}, take(kLimit * 2)), "status 1");
}
#endif

}  // namespace
}  // namespace earshot::netcdf
