#include "firmware/host/program/signals.hpp"

#include <csignal>

namespace earshot::program {

void stop_on_signals(SecondSignal second) {
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    action.sa_handler = [](int) { stop_requested = true; };
    action.sa_flags = SA_RESTART;
    if (second == SecondSignal::kEndsAtOnce) action.sa_flags |= static_cast<int>(SA_RESETHAND);
    sigaction(number, &action, nullptr);
  }
}

void outlive_terminal() {
  (void)std::signal(SIGHUP, SIG_IGN);
}

}  // namespace earshot::program
