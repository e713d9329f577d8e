#include "firmware/host/program/signals.hpp"

#include <csignal>

namespace earshot::program {

void stop_on_signals(SecondSignal second) {
  for (const int number : {SIGINT, SIGTERM, SIGQUIT}) {
    struct sigaction action {};
    action.sa_handler = [](int) { stop_requested = true; };
    action.sa_flags = SA_RESTART;
    if (second == SecondSignal::kEndsAtOnce) action.sa_flags |= static_cast<int>(SA_RESETHAND);
    sigaction(number, &action, nullptr);
  }
}

void ignore_unmeant_signals() {
  for (const int number :
       {SIGHUP, SIGTSTP, SIGTTIN, SIGTTOU, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO, SIGPWR, SIGSTKFLT, SIGXCPU})
    (void)std::signal(number, SIG_IGN);
  for (int number = SIGRTMIN; number <= SIGRTMAX; ++number) (void)std::signal(number, SIG_IGN);
}

void stop_on_sighup() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_requested = true; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGHUP, &action, nullptr);
}

void install_sighup_handler() {
  struct sigaction action {};
  action.sa_handler = [](int) { has_hung_up = true; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGHUP, &action, nullptr);
}

}  // namespace earshot::program
