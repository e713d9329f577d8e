#include "tests/support/private_network.hpp"

#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace earshot::test {

bool enter_private_network() {
  if (::unshare(CLONE_NEWNET) != 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  return std::system(
             "PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo") ==
         0;
}

bool may_do_without_private_network() {
  const char* const required = std::getenv("LCM_REQUIRED");
  return ::geteuid() != 0 && (required == nullptr || std::string_view(required) != "1");
}

}  // namespace earshot::test
