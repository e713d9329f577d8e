#pragma once

#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/program/child_process.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"
#include "sim/apps/fly/other_process.hpp"

namespace earshot::fly {

/// The page that shows a flight while it is flown: earshot-watch beside it, which prints the page's address. It reads the journal alone.
class FlightPage {
 public:
  /// @param folder  where the flight will be
  void begin(const std::filesystem::path& folder) {
    const std::string name = folder.native().starts_with('-') ? "./" + folder.string() : folder.string();
    std::vector<std::string> arguments{name, "--wait", "86400", "--open"};
    if (program::talk() == program::Talk::kQuiet) arguments.emplace_back("--quiet");
    server_.emplace("earshot-watch", arguments);
  }

  /// The flight is over, and can be looked at until Ctrl-C, or until the process ends that it ends with.
  void stay(const std::optional<OtherProcess>& owner) {
    if (!server_) return;
    server_->poll();
    if (server_->running()) program::print() << "  page        stays at the address above until Ctrl-C\n" << std::flush;
    while (server_->running()) {
      if (program::stop_requested || (owner && owner->has_ended())) server_->stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      server_->poll();
    }
  }

 private:
  std::optional<program::ChildProcess> server_;
};

}  // namespace earshot::fly
