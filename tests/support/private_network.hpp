#pragma once

namespace earshot::test {

/// Moves this process into a network namespace of its own with a loopback interface that carries multicast, so that tests neither hear nor
/// disturb anything. The kernel removes it when the process ends. Must be called before any thread starts.
/// @return false where the kernel does not let us (not root and no user namespaces)
[[nodiscard]] bool enter_private_network();

}  // namespace earshot::test
