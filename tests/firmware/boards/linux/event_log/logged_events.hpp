#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "firmware/boards/linux/event_log/event_log.hpp"
#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::board {

/// The event log of a flight, and all that it wrote.
class LoggedEvents : public testing::Test {
 protected:
  void SetUp() override {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    out_ = host::FileDescriptor(ends[0]);
    in_ = host::FileDescriptor(ends[1]);
    writer_.emplace(in_.number());
    event_log_.emplace(ports_, *writer_);
  }

  /// Ends the event log.
  std::string told() {
    event_log_.reset();
    writer_.reset();
    in_ = host::FileDescriptor();
    std::string text(10'000, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(::read(out_.number(), text.data(), text.size()), 0)));
    return text;
  }

 private:
  host::FileDescriptor out_;
  host::FileDescriptor in_;
  PortSet ports_;
  std::optional<LineWriter> writer_;

 protected:
  std::optional<EventLog> event_log_;
};

}  // namespace earshot::board
