#include "firmware/host/transport/bus_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "firmware/host/file/process.hpp"
#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::host {
namespace {

/// A local address in the abstract namespace.
struct Name {
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  socklen_t length = 0;

  template <class Call>
  int with(Call call, const FileDescriptor& socket) const {
    return call(socket.number(), reinterpret_cast<const sockaddr*>(&address), length);
  }
};

FileDescriptor open_local(const std::string& bus) {
  FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.number() < 0) throw std::system_error(errno, std::generic_category(), bus + ": socket");
  return socket;
}

/// Who listens at the name, as the kernel knows it; nothing: it does not say.
std::optional<ucred> listener_at(const Name& name, const std::string& bus) {
  const FileDescriptor asking = open_local(bus);
  ucred holder{};
  socklen_t size = sizeof holder;
  if (name.with(::connect, asking) != 0 || ::getsockopt(asking.number(), SOL_SOCKET, SO_PEERCRED, &holder, &size) != 0 || holder.pid == 0)
    return std::nullopt;
  return holder;
}

std::string holder_of(const Name& name, const std::string& bus) {
  const std::optional<ucred> holder = listener_at(name, bus);
  return holder ? name_of_process(std::to_string(holder->pid)) : "another mission or flight on this machine";
}

}  // namespace

/// A bus, and what to call it.
class BusName {
 public:
  /// @param key  the same text for all who mean the same bus
  BusName(std::string key, std::string bus) : key_(std::move(key)), bus_(std::move(bus)) {}

  [[nodiscard]] BusLock lock() const {
    BusLock lock;
    for (const BusPlace place : {BusPlace::kFlight, BusPlace::kVehicle, BusPlace::kSimulator}) take(place, lock);
    return lock;
  }
  [[nodiscard]] BusLock lock(BusPlace place) const {
    BusLock lock;
    take(place, lock);
    return lock;
  }
  [[nodiscard]] BusLock lock_at_sea(const std::filesystem::path& folder) const {
    BusLock lock;
    const bool has_file = take_file(folder, lock);
    for (const BusPlace place : {BusPlace::kFlight, BusPlace::kVehicle, BusPlace::kSimulator}) {
      try {
        take(place, lock);
      } catch (const BusInUse& e) {
        const std::optional<ucred> holder = listener_at(name_of(place), bus_);
        const bool is_stranger = holder ? holder->uid != 0 && holder->uid != ::geteuid() : has_file;
        if (!is_stranger) throw;
        lock.stranger_ = e.what();
      }
    }
    return lock;
  }

 private:
  void take(BusPlace place, BusLock& lock) const {
    const Name name = name_of(place);
    FileDescriptor socket = open_local(bus_);
    if (name.with(::bind, socket) == 0) {
      // Nobody is ever answered: who connects learns from the kernel who listens.
      constexpr int kAsking = 64;
      if (::listen(socket.number(), kAsking) != 0) throw std::system_error(errno, std::generic_category(), bus_ + ": listen");
      lock.places_[static_cast<std::size_t>(place)] = std::move(socket);
      return;
    }
    if (errno == EADDRINUSE) throw BusInUse(bus_ + ": " + holder_of(name, bus_) + " is using it");
    throw std::system_error(errno, std::generic_category(), bus_ + ": bind");
  }

  /// @return whether it is held; where no such file can be made, the name alone counts
  [[nodiscard]] bool take_file(const std::filesystem::path& folder, BusLock& lock) const {
    if (folder.empty()) return false;
    std::string name = "bus-" + key_ + ".lock";
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-'; }, '_');
    lock.file_ = FileDescriptor(::open((folder / name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (lock.file_.number() < 0) return false;
    if (::flock(lock.file_.number(), LOCK_EX | LOCK_NB) == 0) return true;
    throw BusInUse(bus_ + ": another mission of this service is using it (" + (folder / name).string() + ")");
  }

  [[nodiscard]] Name name_of(BusPlace place) const {
    const std::string text = "earshot-bus " + key_ + " " + std::to_string(static_cast<int>(place));
    Name name;
    if (text.size() >= sizeof(name.address.sun_path)) throw std::system_error(ENAMETOOLONG, std::generic_category(), bus_);
    std::copy(text.begin(), text.end(), name.address.sun_path + 1);  // a first byte of zero: the abstract namespace
    name.length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
    return name;
  }

  std::string key_;
  std::string bus_;
};

namespace {

BusName lcm_bus(std::string_view url) {
  const LcmUrl parsed = parse_lcm_url(url);
  return {"lcm " + std::to_string(parsed.group) + ":" + std::to_string(parsed.port), std::string(url)};
}

BusName can_bus(std::string_view interface) {
  return {"can " + std::string(interface), "CAN interface " + std::string(interface)};
}

}  // namespace

BusLock::BusLock(BusLock&& other) noexcept = default;
BusLock& BusLock::operator=(BusLock&& other) noexcept = default;

void BusLock::leave_to_children() {
  for (const BusPlace place : {BusPlace::kVehicle, BusPlace::kSimulator}) places_[static_cast<std::size_t>(place)] = FileDescriptor();
}

BusLock lock_lcm(std::string_view url) {
  return lcm_bus(url).lock();
}

BusLock lock_lcm(std::string_view url, BusPlace place) {
  return lcm_bus(url).lock(place);
}

BusLock lock_lcm_at_sea(std::string_view url, const std::filesystem::path& folder) {
  return lcm_bus(url).lock_at_sea(folder);
}

BusLock lock_can(std::string_view interface) {
  return can_bus(interface).lock();
}

BusLock lock_can(std::string_view interface, BusPlace place) {
  return can_bus(interface).lock(place);
}

BusLock lock_can_at_sea(std::string_view interface, const std::filesystem::path& folder) {
  return can_bus(interface).lock_at_sea(folder);
}

}  // namespace earshot::host
