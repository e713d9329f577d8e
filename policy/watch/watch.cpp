#include "policy/watch/watch.hpp"

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"
#include "policy/report/page/page_template.hpp"
#include "policy/watch/desktop_browser.hpp"
#include "policy/watch/followed_flight.hpp"
#include "policy/watch/foxglove/foxglove_feed.hpp"
#include "policy/watch/http/audience.hpp"
#include "policy/watch/http/server.hpp"
#include "policy/watch/lcm_flight.hpp"
#include "policy/watch/publisher.hpp"

namespace earshot::watch {
namespace {

constexpr std::chrono::milliseconds kBetweenTurns{20};

ServerSettings settings_of(const WatchOptions& options) {
  ServerSettings settings{.page = report::page_template()};
  if (options.listen && !options.password_file)
    throw host::BadInput("--listen " + *options.listen + ": others could read the flight: needs --password-file");
  if (options.listen && !is_address(*options.listen))
    throw host::BadInput("--listen " + *options.listen + ": must be an address of this computer, such as 192.168.2.7, or 0.0.0.0 for all");
  if (options.listen) settings.address = *options.listen;
  if (options.password_file) settings.password = Password::of_file(*options.password_file);
  return settings;
}

/// On the usual port, so that an address that somebody kept is right again; on any other where that is taken.
std::unique_ptr<Server> serve(ServerSettings settings, std::optional<std::uint32_t> port, Audience& audience) {
  if (port) settings.port = static_cast<std::uint16_t>(*port);
  try {
    return std::make_unique<Server>(settings, audience);
  } catch (const PortTaken&) {
    if (port) throw;
  }
  settings.port = 0;
  return std::make_unique<Server>(settings, audience);
}

std::unique_ptr<FlightSource> source_of(const WatchOptions& options) {
  if (options.what == kLcm) return std::make_unique<LcmFlight>(options.lcm_url);
  std::optional<std::chrono::seconds> wait;
  if (options.wait_s) wait = std::chrono::seconds(*options.wait_s);
  return std::make_unique<FollowedFlight>(options.what, wait);
}

}  // namespace

int watch(const WatchOptions& options) {
  const ServerSettings settings = settings_of(options);
  program::stop_on_signals();
  const std::unique_ptr<FlightSource> source = source_of(options);
  std::optional<FoxgloveFeed> foxglove;
  if (options.foxglove) foxglove.emplace(static_cast<std::uint16_t>(options.foxglove_port));
  if (foxglove) source->observe([&](const journal::Entry& entry) { foxglove->take(entry); });
  Change change = source->take();  // what is no journal is refused before anybody is served
  Audience audience;
  const std::unique_ptr<Server> server = serve(settings, options.port, audience);
  program::print() << server->url() << "\n";
  if (foxglove) program::print() << foxglove->url() << "\n";
  program::print() << std::flush;
  if (options.open) open_in_browser(server->url());
  Publisher publisher(audience);
  while (!program::stop_requested) {
    publisher.update(source->flight(), change);
    if (server->has_failed()) {
      std::cerr << "earshot watch: the operating system takes no more connections for " << server->url() << "\n";
      return program::kLost;
    }
    source->wait(kBetweenTurns);
    change = source->take();
  }
  program::detail() << "earshot watch: " << audience.dropped_frames() << " frames dropped for browsers that read too slowly\n";
  return program::kDone;
}

}  // namespace earshot::watch
