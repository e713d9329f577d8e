#pragma once

namespace earshot::test {

/// Moves this process into a network namespace of its own with a loopback interface that carries multicast, so that tests neither hear nor
/// disturb anything. The kernel removes it when the process ends. Must be called before any thread starts.
/// @return false where the kernel does not let us (not root and no user namespaces)
[[nodiscard]] bool enter_private_network();

/// Whether tests that need one may be skipped: not for root, who can make one, nor with LCM_REQUIRED=1.
[[nodiscard]] bool may_do_without_private_network();

inline constexpr const char* kNoPrivateNetwork =
    "no network namespace could be made (package iproute2), but this is root or LCM_REQUIRED=1";
inline constexpr const char* kOnlyRootMayHavePrivateNetwork = "this kernel lets only root make a network namespace";

}  // namespace earshot::test

/// In a test or its SetUp(): enter_private_network(), or the test ends here, skipped where it may be, failed otherwise. A macro, because
/// GTest's skip returns from the function that it stands in.
#define ENTER_PRIVATE_NETWORK_OR_SKIP()                                                               \
  do {                                                                                                \
    if (earshot::test::enter_private_network()) break;                                                \
    ASSERT_TRUE(earshot::test::may_do_without_private_network()) << earshot::test::kNoPrivateNetwork; \
    GTEST_SKIP() << earshot::test::kOnlyRootMayHavePrivateNetwork;                                    \
  } while (false)
