#pragma once

#include <cstdint>
#include <string>

#include "firmware/boards/linux/port/port.hpp"
#include "firmware/host/memory/process_memory.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::endurance {

/// What a tool must be able to catch; planted by its tests.
enum class Plant : std::uint8_t { kNothing, kAllocation, kPage, kWrap };

/// Looks at every turn: counts what comes out, sees that no counter goes back, notes the memory after the first hour. Hears health on a bus
/// as anybody does, and puts nonsense there.
class Witness final : public board::Port {
 public:
  Witness(std::uint8_t index, const std::string& lcm_url, Duration period, Plant plant);

  void collect(board::Clock& clock, board::InputSink& sink) override;
  std::uint64_t publish(Time now, const runtime::Outputs& outputs) override;
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] board::PortWords words() const override { return {.label = "a witness"}; }

  /// What came out.
  struct Seen {
    std::uint64_t turns = 0;
    std::uint64_t setpoints = 0;
    std::uint64_t decisions = 0;
    std::uint64_t acknowledgements = 0;
    std::uint64_t went_back = 0;    ///< turns after which a counter was lower than before
    std::uint64_t misnumbered = 0;  ///< decisions whose step was not one above the last one's
    std::uint64_t heard = 0;        ///< health messages on the bus
    std::uint64_t nonsense_sent = 0;
    messages::Health last;
    host::ProcessMemory first_hour;
  };
  [[nodiscard]] const Seen& seen() const { return seen_; }

 private:
  void listen();
  void do_planted();

  host::LcmEndpoint bus_;
  std::uint64_t turns_an_hour_;
  Plant plant_;
  Seen seen_;
};

}  // namespace earshot::endurance
