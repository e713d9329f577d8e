#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/core/status.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/if_missing.hpp"
#include "firmware/host/transport/lcm_interfaces.hpp"
#include "firmware/host/transport/lcm_url.hpp"
#include "firmware/host/transport/socket_drops.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::host {

/// Counters of an endpoint; they only grow.
struct LcmCounters {
  std::uint64_t published = 0;
  std::uint64_t publish_failed = 0;      ///< the kernel refused (buffer full, interface down)
  std::uint64_t received = 0;            ///< messages put into a queue
  std::uint64_t overwritten = 0;         ///< messages lost because kLcmQueueDepth newer ones came before they were taken
  std::uint64_t lost_by_kernel = 0;      ///< datagrams that came faster than collect() read them
  std::uint64_t from_elsewhere = 0;      ///< datagrams of other hosts, where ttl=0 means this one only
  std::uint64_t other_channels = 0;      ///< messages on channels not subscribed
  std::uint64_t interfaces_unheard = 0;  ///< at present: interfaces or addresses beyond what it or the kernel allows one socket
  wire::ReceiveCounters datagrams;
};

/// A peer on LCM's UDP multicast bus, interoperable with stock liblcm, in memory that is fixed once it is constructed.
/// Channels are named at construction; every other name is ignored (and counted), so that strange names cost nothing.
/// When messages come faster than they are taken, the newest kLcmQueueDepth of each channel stay; one channel cannot push out another, and
/// nothing pushes out a message that is to be kept.
/// It does not hear itself. It listens on every interface of the host, because stock peers send where the routes lead, loopback or not;
/// with ttl=0 it sends over the loopback interface and hears only senders on this host.
///
///     endpoint.collect();
///     for (wire::Lc02Message m; endpoint.take(m) == Status::kOk;) ...
class LcmEndpoint {
 public:
  /// Whether a message must not be pushed out by newer ones; as many as fit into its queue are kept.
  using MustKeep = bool (*)(std::string_view channel, std::span<const std::uint8_t> data);

  /// A network that is not there is an error with kRefuse; with kKeepTrying it is down until refresh_interfaces() finds it.
  /// @throws std::system_error naming the call that failed; std::invalid_argument for more than kLcmSubscriptions channels or a name
  /// not 1..63 bytes.
  LcmEndpoint(const LcmUrl& url, const std::vector<std::string_view>& channels, MustKeep must_keep = nullptr,
              IfMissing if_missing = IfMissing::kRefuse);
  ~LcmEndpoint();

  /// Sends one message. kOutOfRange: LCM cannot carry it. kFull: the kernel refused it; try again or count it as lost.
  [[nodiscard]] Status publish(std::string_view channel, std::span<const std::uint8_t> data);

  /// Reads what has arrived, at most `most` datagrams, without waiting. Who must not miss one of many reads one at a time, and takes.
  /// @return how many it read
  std::size_t collect(std::size_t most = config::kLcmDatagramsPerCollect);

  /// The oldest message collected and not yet taken, in order of arrival over all channels; kNotReady if there is none.
  /// @param message  valid until the next collect()
  [[nodiscard]] Status take(wire::Lc02Message& message);

  /// Listens on interfaces that came up since, too, and sends again by the routes that there are now, if it could not. Allocates nothing.
  void refresh_interfaces();
  /// False while there is no interface to listen on, and once the kernel had no way for a message, until refresh_interfaces() finds one.
  [[nodiscard]] bool is_up() const { return is_up_; }
  /// Names of the interfaces that it listens on, "lo, eth0", and why not on others, as LcmInterfaces::names() says.
  [[nodiscard]] std::string interfaces() const { return interfaces_.names(); }

  /// For poll(): readable when collect() has something to read.
  [[nodiscard]] int file_descriptor() const { return receiver_.number(); }
  [[nodiscard]] LcmCounters counters() const;
  /// Bytes of its queues and of what is put together from datagrams.
  [[nodiscard]] std::size_t memory() const;

 private:
  struct Storage;
  /// Joins the group and finds a way to send. False: on no interface; or, with errno, no way.
  [[nodiscard]] bool join();
  [[nodiscard]] bool open_sender();
  void enqueue(const wire::Lc02Message& message);

  LcmUrl url_;
  MustKeep must_keep_;
  LcmInterfaces interfaces_;
  FileDescriptor sender_;
  FileDescriptor receiver_;
  SocketDrops drops_;
  bool is_up_ = false;
  wire::Sender self_;
  std::uint32_t sequence_number_ = 0;
  LcmCounters counters_;
  std::unique_ptr<Storage> storage_;  ///< reassembly, and a queue of kLcmQueueDepth * kLcmMessageBytes for each channel
};

}  // namespace earshot::host
