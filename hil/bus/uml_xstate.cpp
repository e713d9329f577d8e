// Preloaded into user-mode Linux by with-can, where the processor has AMX.
//
// User-mode Linux 6.1 (Debian 12) keeps 2696 bytes of a process's extended state, all that there was up to AVX-512. With AMX there are
// 11008, the host's kernel takes back nothing but the whole, and user-mode Linux hangs for ever as it starts its first process. Here the
// rest of what it gives back is filled up with zeros: state components that the header calls unused.

#include <dlfcn.h>
#include <elf.h>
#include <sys/ptrace.h>
#include <sys/uio.h>

#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstring>

namespace {

constexpr std::size_t kMostState = 65536;  // bytes; room for components to come
// Not on the stack: a kernel's stack is 16 KiB. One thread only traces.
alignas(64) std::array<unsigned char, kMostState> whole_state;

}  // namespace

extern "C" long ptrace(enum __ptrace_request request, ...) {  // NOLINT: the C library's own signature
  std::va_list arguments;
  va_start(arguments, request);
  const int process = va_arg(arguments, int);
  void* const address = va_arg(arguments, void*);
  void* const data = va_arg(arguments, void*);
  va_end(arguments);

  using Ptrace = long (*)(enum __ptrace_request, ...);
  static const auto next = reinterpret_cast<Ptrace>(dlsym(RTLD_NEXT, "ptrace"));
  if (request == PTRACE_SETREGSET && address == reinterpret_cast<void*>(NT_X86_XSTATE)) {
    const auto& given = *static_cast<const iovec*>(data);
    iovec whole{.iov_base = whole_state.data(), .iov_len = whole_state.size()};
    if (next(PTRACE_GETREGSET, process, address, &whole) == 0 && given.iov_len < whole.iov_len) {
      whole_state.fill(0);
      std::memcpy(whole_state.data(), given.iov_base, given.iov_len);
      return next(request, process, address, &whole);
    }
  }
  return next(request, process, address, data);
}
