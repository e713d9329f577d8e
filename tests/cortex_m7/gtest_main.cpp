// GoogleTest on a machine without an operating system: its words and its end go to the emulator (semihosting, newlib's librdimon).

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdio>
#include <cstdlib>

extern "C" {
void initialise_monitor_handles();

// What a C library's own start-up would bring, and files that no test of the core makes.
void* __dso_handle = nullptr;
void _fini() {}
int mkdir(const char* /*path*/, mode_t /*mode*/) {
  return -1;
}
}

int main() {
  initialise_monitor_handles();
  int argc = 1;
  char name[] = "test";
  char* argv[] = {name, nullptr};
  testing::InitGoogleTest(&argc, argv);
  // They hold more than the 16 MB that there are.
  GTEST_FLAG_SET(filter, "-SoundSnr.OfNoiseAloneIsTooFaintButOnceInAThousand:OperatingCharacteristic.*");
  const int status = RUN_ALL_TESTS();
  std::printf("exit status %d\n", status);
  std::exit(status);
}
