#pragma once

#include <poll.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/boards/linux/port/further_duties.hpp"
#include "firmware/boards/linux/port/port.hpp"
#include "firmware/config/capacities.hpp"

namespace earshot::board {

/// Port 0 of every input: this computer itself (its stop signal). The mission's ports count from 1.
inline constexpr std::uint8_t kOwnPort = messages::kOwnPort;

/// All ports of a vehicle, polled as one: owns them, and the counts that were reported of each. Nothing allocates once they have been
/// added.
class PortSet {
 public:
  /// @throws std::invalid_argument for more than kMaxPorts - 1.
  void add(std::unique_ptr<Port> port);
  /// The index of the port that is added next.
  [[nodiscard]] std::uint8_t next_index() const { return static_cast<std::uint8_t>(ports_.size() + 1); }

  /// From each port in turn.
  void collect(Clock& clock, InputSink& sink);
  void publish(Time now, const runtime::Outputs& outputs);
  void publish_detection(const messages::SoundDetection& detection);
  void note_speed(MetersPerSecond speed);
  /// Gives `sink` the report of every port that has changed since it was last given.
  void report_changes(InputSink& sink);
  /// Counts on from what a process before this one reported: counters only grow.
  void count_on_from(const std::array<messages::PortReport, config::kMaxPorts>& reported);
  /// A message that the port brought was not taken: its report counts it.
  void count_lost(std::uint8_t port) { ++before_.at(port).lost; }
  /// Lets the members of a bus do what it wants of them; to be called at least ten times a second of the host's time.
  void serve();
  /// Waits until every member of a bus whose link is up could send, but no longer than `most`.
  void settle(std::chrono::milliseconds most);
  /// Looks after every link, once a second of the host's time however often it is called.
  void tend();

  /// One for each port whose link is up; valid until the next call of any kind.
  [[nodiscard]] std::span<const pollfd> readable();
  [[nodiscard]] std::uint64_t setpoints_sent() const { return setpoints_sent_; }
  /// Whether there is an autopilot's port among them: without one nobody is to have set-points.
  [[nodiscard]] bool carries_setpoints() const;
  /// Of all sound listeners.
  [[nodiscard]] std::uint64_t blocks_heard() const;
  /// The descriptions of the ports whose links are down, a line each; empty when all are up.
  [[nodiscard]] std::string down() const;
  /// Says where each port listens, a line each.
  [[nodiscard]] std::string description() const;
  struct Link {
    std::uint8_t port = 0;
    std::string label;  ///< "port 1, vehicle, CAN can0"
    bool is_up = true;
  };
  [[nodiscard]] std::vector<Link> links() const;
  struct Held {
    std::string port;  ///< its index and description
    std::size_t bytes = 0;
  };
  /// The memory that each port holds for its queues and buffers.
  [[nodiscard]] std::vector<Held> memory() const;
  /// Remarks for a person at the end of a flight, such as losses.
  [[nodiscard]] std::vector<std::string> remarks() const;
  /// Of every port that met some.
  [[nodiscard]] std::vector<std::string> strangers() const;
  /// The sum of the reports of all ports that carry messages; a hydrophone's report counts samples and is left out.
  [[nodiscard]] messages::PortReport sum() const;

 private:
  std::vector<std::unique_ptr<Port>> ports_;
  std::vector<BusMember*> bus_members_;  ///< those of ports_ that are members of a bus, in the order of ports_
  std::vector<SoundListener*> sound_listeners_;
  std::vector<DetectionSender*> detection_senders_;
  std::array<messages::PortReport, config::kMaxPorts> reported_{};
  std::array<messages::PortReport, config::kMaxPorts> before_{};  ///< counted by a process before this one, and by count_lost()
  std::array<pollfd, config::kMaxPorts> readable_{};
  std::uint64_t setpoints_sent_ = 0;
  std::chrono::steady_clock::time_point last_tended_ = std::chrono::steady_clock::now();
};

}  // namespace earshot::board
