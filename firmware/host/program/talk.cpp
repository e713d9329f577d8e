#include "firmware/host/program/talk.hpp"

#include <atomic>
#include <iostream>

namespace earshot::program {
namespace {

std::atomic<Talk> current{Talk::kNormal};
std::ostream nowhere(nullptr);

}  // namespace

Talk talk() {
  return current;
}

void set_talk(Talk talk) {
  current = talk;
}

std::ostream& print() {
  return talk() == Talk::kQuiet ? nowhere : std::cout;
}

std::ostream& detail() {
  return talk() == Talk::kVerbose ? std::cerr : nowhere;
}

}  // namespace earshot::program
