// Positive control of the symbol check: it must be found out.
#include <cstdio>

void say(int number) {
  std::printf("%d\n", number);
}
