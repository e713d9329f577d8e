// Loaded into a program by LD_PRELOAD: beside the system call that EARSHOT_TEST_ASKS_IN names, the program asks for memory in the way of
// EARSHOT_TEST_ASKS_BY. What counts allocations must catch it.

#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string_view>

namespace {

struct alignas(256) Wide {
  std::array<std::byte, 256> bytes;
};

void* volatile kept = nullptr;

void ask_by(std::string_view how) {
  constexpr std::size_t kPage = 4096;
  constexpr int kPrivate = MAP_PRIVATE | MAP_ANONYMOUS;
  if (how == "malloc") {
    kept = std::malloc(kPage);
    std::free(kept);
  } else if (how == "aligned new") {
    auto* const made = new Wide;
    kept = made;
    delete made;
  } else if (how == "mmap") {
    kept = ::mmap(nullptr, kPage, PROT_READ, kPrivate, -1, 0);
    (void)::munmap(kept, kPage);
  } else {
    (void)::syscall(SYS_mmap, nullptr, kPage, PROT_READ, kPrivate, -1, 0);
  }
}

void ask_in(std::string_view call) {
  const char* const in = std::getenv("EARSHOT_TEST_ASKS_IN");
  const char* const by = std::getenv("EARSHOT_TEST_ASKS_BY");
  if (in != nullptr && by != nullptr && call == in) ask_by(by);
}

}  // namespace

extern "C" {
ssize_t recvfrom(int socket, void* data, std::size_t size, int flags, sockaddr* from, socklen_t* from_size) {
  ask_in("recvfrom");
  return ::syscall(SYS_recvfrom, socket, data, size, flags, from, from_size);
}
ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  ask_in("sendmsg");
  return ::syscall(SYS_sendmsg, socket, message, flags);
}
int fdatasync(int file) {
  ask_in("fdatasync");
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}
int ppoll(pollfd* files, nfds_t count, const timespec* most, const sigset_t* signals) {
  ask_in("ppoll");
  timespec left = *most;  // the system call writes what is left
  return static_cast<int>(::syscall(SYS_ppoll, files, count, &left, signals, _NSIG / 8));
}
}
