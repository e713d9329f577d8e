#include "firmware/host/transport/lcm_endpoint.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace earshot::host {

namespace {

[[noreturn]] void fail(const char* call) {
  throw std::system_error(errno, std::generic_category(), std::string("LCM: ") + call);
}

template <class Value>
void set_option(const FileDescriptor& socket, int level, int name, const Value& value, const char* what) {
  if (::setsockopt(socket.number(), level, name, &value, sizeof value) != 0) fail(what);
}

FileDescriptor open_udp() {
  FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (socket.number() < 0) fail("socket");
  return socket;
}

sockaddr_in address_of(const LcmUrl& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(url.group);
  address.sin_port = htons(url.port);
  return address;
}

template <class Call>
int with_address(Call call, const FileDescriptor& socket, const sockaddr_in& address) {
  return call(socket.number(), reinterpret_cast<const sockaddr*>(&address), socklen_t{sizeof address});
}

template <class Value>
bool takes_option(const FileDescriptor& socket, int name, const Value& value) {
  return ::setsockopt(socket.number(), IPPROTO_IP, name, &value, sizeof value) == 0;
}

/// @return no socket, and errno, where there is no way to the group
FileDescriptor try_to_open_sender(const LcmUrl& url) {
  FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  in_addr loopback{};
  loopback.s_addr = htonl(INADDR_LOOPBACK);
  const bool is_open = socket.number() >= 0 && (url.ttl > 0 || takes_option(socket, IP_MULTICAST_IF, loopback)) &&
                       takes_option(socket, IP_MULTICAST_TTL, url.ttl) && takes_option(socket, IP_MULTICAST_LOOP, 1) &&
                       with_address(::connect, socket, address_of(url)) == 0;
  return is_open ? std::move(socket) : FileDescriptor();
}

/// An ABORT behind a burst of other traffic must not be dropped: as much room as the kernel gives us (beyond its limit only to root).
void widen(const FileDescriptor& socket) {
  constexpr int kReceiveBytes = 4 * 1024 * 1024;
  if (::setsockopt(socket.number(), SOL_SOCKET, SO_RCVBUFFORCE, &kReceiveBytes, sizeof kReceiveBytes) == 0) return;
  (void)::setsockopt(socket.number(), SOL_SOCKET, SO_RCVBUF, &kReceiveBytes, sizeof kReceiveBytes);
}

FileDescriptor open_receiver(const LcmUrl& url) {
  FileDescriptor socket = open_udp();
  set_option(socket, SOL_SOCKET, SO_REUSEADDR, 1, "SO_REUSEADDR");
  if (url.receive_buffer_bytes > 0) {
    set_option(socket, SOL_SOCKET, SO_RCVBUF, url.receive_buffer_bytes, "SO_RCVBUF");
  } else {
    widen(socket);
  }
  // Without this Linux also hands over what other sockets of this host joined on other interfaces.
  set_option(socket, IPPROTO_IP, IP_MULTICAST_ALL, 0, "IP_MULTICAST_ALL");
  if (with_address(::bind, socket, address_of(url)) != 0) fail("bind");
  return socket;
}

wire::Sender sender_of(const sockaddr_in& address) {
  return {address.sin_addr.s_addr, address.sin_port};
}

const std::vector<std::string_view>& checked(const std::vector<std::string_view>& channels) {
  if (channels.size() > config::kLcmSubscriptions)
    throw std::invalid_argument("LCM: more than " + std::to_string(config::kLcmSubscriptions) + " channels");
  for (const std::string_view channel : channels) {
    if (wire::datagram_count({channel, {}}) == 0)
      throw std::invalid_argument("LCM channel \"" + std::string(channel) + "\": must have 1 to 63 bytes");
  }
  return channels;
}

wire::Sender local_address(const FileDescriptor& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  (void)::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&address), &size);  // fails for nothing that is a socket
  return sender_of(address);
}

}  // namespace

struct LcmEndpoint::Storage {
  struct Entry {
    std::uint64_t arrival = 0;
    bool kept = false;  ///< not to be pushed out
    std::size_t size = 0;
    std::array<std::uint8_t, config::kLcmMessageBytes> data;
  };
  /// The newest messages of one channel, a ring.
  struct Queue {
    std::string channel;
    std::size_t first = 0;
    std::size_t count = 0;
    std::array<Entry, config::kLcmQueueDepth> entries;

    [[nodiscard]] Entry& at(std::size_t i) { return entries[(first + i) % entries.size()]; }
    /// Makes room for one more in a full queue; false when everything in it is to be kept.
    [[nodiscard]] bool push_out_oldest() {
      std::size_t oldest = 0;
      while (oldest < count && at(oldest).kept) ++oldest;
      if (oldest == count) return false;
      for (; oldest > 0; --oldest) at(oldest) = at(oldest - 1);  // rare: a kept message moves up
      first = (first + 1) % entries.size();
      --count;
      return true;
    }
  };
  explicit Storage(const std::vector<std::string_view>& channels) : queues(new Queue[channels.size()]), count(channels.size()) {
    for (std::size_t i = 0; i < count; ++i) queues[i].channel = channels[i];
  }
  [[nodiscard]] std::span<Queue> all() { return {queues.get(), count}; }
  [[nodiscard]] std::size_t memory() const { return sizeof *this + count * sizeof(Queue); }

  std::unique_ptr<Queue[]> queues;  ///< of the channels that are listened to
  std::size_t count;
  std::uint64_t arrivals = 0;
  wire::Reassembly reassembly;
  std::array<std::uint8_t, wire::kMaxDatagram> datagram;
};

LcmEndpoint::LcmEndpoint(const LcmUrl& url, const std::vector<std::string_view>& channels, MustKeep must_keep, IfMissing if_missing)
    : url_(url), must_keep_(must_keep), receiver_(open_receiver(url)), storage_(new Storage(checked(channels))) {
  const bool is_refused = if_missing == IfMissing::kRefuse;
  const bool hears = join();
  if (!hears && is_refused) fail("no interface is up on which the multicast group can be joined");
  const bool sends = open_sender();
  // That passes no sooner than the program does: a port that never sends is none.
  if (!sends && (errno == EMFILE || errno == ENFILE)) fail("socket");
  if (!sends && is_refused) fail("no route to the multicast group");
  is_up_ = hears && sends;
}

LcmEndpoint::~LcmEndpoint() = default;

Status LcmEndpoint::publish(std::string_view channel, std::span<const std::uint8_t> data) {
  const wire::Lc02Message message{channel, data};
  const std::size_t count = wire::datagram_count(message);
  if (count == 0) return Status::kOutOfRange;
  const std::uint32_t number = sequence_number_++;
  for (std::size_t i = 0; i < count; ++i) {
    wire::Datagram datagram;
    if (const Status status = wire::compose(message, number, i, datagram); status != Status::kOk) return status;
    std::array<iovec, 2> pieces{iovec{datagram.head.data(), datagram.head_size},
                                iovec{const_cast<std::uint8_t*>(datagram.data.data()), datagram.data.size()}};  // sendmsg does not write
    msghdr header{};
    header.msg_iov = pieces.data();
    header.msg_iovlen = pieces.size();
    if (::sendmsg(sender_.number(), &header, 0) < 0) {
      ++counters_.publish_failed;
      is_up_ = is_up_ && (errno == EAGAIN || errno == ENOBUFS || errno == EINTR);
      return Status::kFull;
    }
  }
  ++counters_.published;
  return Status::kOk;
}

std::size_t LcmEndpoint::collect(std::size_t most) {
  for (std::size_t i = 0; i < most; ++i) {
    sockaddr_in from{};
    socklen_t from_size = sizeof from;
    const ssize_t size = ::recvfrom(receiver_.number(), storage_->datagram.data(), storage_->datagram.size(), 0,
                                    reinterpret_cast<sockaddr*>(&from), &from_size);
    if (size < 0) return i;
    if (sender_of(from) == self_) continue;
    if (url_.ttl == 0 && !interfaces_.is_own(from.sin_addr.s_addr)) {
      ++counters_.from_elsewhere;
      continue;
    }
    wire::Lc02Message message;
    const std::span<const std::uint8_t> datagram{storage_->datagram.data(), static_cast<std::size_t>(size)};
    if (storage_->reassembly.accept(datagram, sender_of(from), message) == Status::kOk) enqueue(message);
  }
  return most;
}

void LcmEndpoint::enqueue(const wire::Lc02Message& message) {
  const std::span<Storage::Queue> queues = storage_->all();
  const auto queue = std::ranges::find(queues, message.channel, &Storage::Queue::channel);
  if (queue == queues.end()) {
    ++counters_.other_channels;
    return;
  }
  if (queue->count == queue->entries.size()) {
    ++counters_.overwritten;
    if (!queue->push_out_oldest()) return;
  }
  Storage::Entry& entry = queue->entries[(queue->first + queue->count++) % queue->entries.size()];
  entry.arrival = storage_->arrivals++;
  entry.kept = must_keep_ != nullptr && must_keep_(message.channel, message.data);
  entry.size = message.data.size();
  std::ranges::copy(message.data, entry.data.begin());
  ++counters_.received;
}

Status LcmEndpoint::take(wire::Lc02Message& message) {
  Storage::Queue* oldest = nullptr;
  std::uint64_t arrival = std::numeric_limits<std::uint64_t>::max();
  for (Storage::Queue& queue : storage_->all()) {
    if (queue.count > 0 && queue.entries[queue.first].arrival < arrival) {
      oldest = &queue;
      arrival = queue.entries[queue.first].arrival;
    }
  }
  if (oldest == nullptr) return Status::kNotReady;
  const Storage::Entry& entry = oldest->entries[oldest->first];
  message = {oldest->channel, {entry.data.data(), entry.size}};
  oldest->first = (oldest->first + 1) % oldest->entries.size();
  --oldest->count;
  return Status::kOk;
}

bool LcmEndpoint::join() {
  return interfaces_.join_all(receiver_.number(), htonl(url_.group)) > 0;
}

bool LcmEndpoint::open_sender() {
  FileDescriptor sender = try_to_open_sender(url_);
  if (sender.number() < 0) return false;
  sender_ = std::move(sender);
  self_ = local_address(sender_);
  return true;
}

void LcmEndpoint::refresh_interfaces() {
  interfaces_.refresh();
  const bool hears = join();
  is_up_ = hears && (is_up_ || open_sender());
}

std::size_t LcmEndpoint::memory() const {
  return storage_->memory();
}

LcmCounters LcmEndpoint::counters() const {
  LcmCounters counters = counters_;
  counters.lost_by_kernel = drops_.count(receiver_.number());
  counters.datagrams = storage_->reassembly.counters();
  counters.interfaces_unheard = interfaces_.unheard();
  return counters;
}

}  // namespace earshot::host
