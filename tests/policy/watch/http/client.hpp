#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::watch {

/// The other side of the server: a socket to which a test writes what it likes.
class Client {
 public:
  explicit Client(std::uint16_t port, int receive_buffer_bytes = 0, const char* address = "127.0.0.1")
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer_bytes > 0)
      ::setsockopt(socket_.number(), SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof(receive_buffer_bytes));
    sockaddr_in server{};
    server.sin_family = AF_INET;
    server.sin_port = htons(port);
    ::inet_pton(AF_INET, address, &server.sin_addr);
    if (::connect(socket_.number(), reinterpret_cast<const sockaddr*>(&server), sizeof(server)) != 0)
      throw std::runtime_error("not connected");
  }

  /// @return false: the server took no more
  bool send(std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::send(socket_.number(), text.data(), text.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  /// All that comes until `end` is part of it, the server closes, or the time is over.
  std::string read_until(std::string_view end, std::chrono::milliseconds most = std::chrono::seconds(20)) {
    const auto deadline = std::chrono::steady_clock::now() + most;
    while (end.empty() || read_.find(end) == std::string::npos) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
      pollfd waits{socket_.number(), POLLIN, 0};
      if (left.count() <= 0 || ::poll(&waits, 1, static_cast<int>(left.count())) <= 0) break;
      std::array<char, 65'536> bytes{};
      const ssize_t count = ::recv(socket_.number(), bytes.data(), bytes.size(), 0);
      if (count <= 0) {
        is_closed_ = true;
        break;
      }
      read_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    const std::size_t at = end.empty() ? std::string::npos : read_.find(end);
    const std::size_t size = at == std::string::npos ? read_.size() : at + end.size();
    std::string text = read_.substr(0, size);
    read_.erase(0, size);
    return text;
  }
  std::string read_all() { return read_until(""); }
  [[nodiscard]] bool is_closed() const { return is_closed_; }

 private:
  host::FileDescriptor socket_;
  std::string read_;
  bool is_closed_ = false;
};

/// "GET /events", and the headers that a browser on this computer sends.
inline std::string request(const std::string& line, const std::string& headers = "", const std::string& host = "127.0.0.1") {
  return line + " HTTP/1.1\r\nHost: " + host + "\r\n" + headers + "\r\n";
}

/// The whole answer to one request.
inline std::string answer(std::uint16_t port, const std::string& text) {
  Client client(port);
  client.send(text);
  return client.read_all();
}

/// 200 of "HTTP/1.1 200 OK"; 0: no answer.
inline int status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

inline std::uint16_t port_in(const std::string& url) {
  return static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
}

}  // namespace earshot::watch
