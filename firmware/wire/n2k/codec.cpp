#include "firmware/wire/n2k/codec.hpp"

#include <algorithm>
#include <cassert>

namespace earshot::n2k {

namespace {

const Message& message_with(std::uint32_t pgn) {
  const Message* message = find_message(pgn);
  assert(message != nullptr);
  return *message;
}

}  // namespace

MessageWriter::MessageWriter(std::uint32_t pgn) : message_(message_with(pgn)), bytes_(blank(message_)) {}

MessageWriter& MessageWriter::set(std::string_view signal, double value) {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  const Status status = encode(*found, value, bytes_);
  if (status_ == Status::kOk) status_ = status;
  return *this;
}

Status MessageWriter::frame(std::uint8_t source, Frame& frame) const {
  if (message_.size > frame.data.size()) return Status::kOutOfRange;
  const Result<std::uint32_t> id = compose(identifier(source));
  if (status_ != Status::kOk) return status_;
  if (!id.ok()) return id.status();
  frame.identifier = id.value();
  frame.size = message_.size;
  for (std::size_t i = 0; i < frame.data.size(); ++i) frame.data[i] = bytes_[i];
  return Status::kOk;
}

Result<double> read(std::uint32_t pgn, std::string_view signal, std::span<const std::uint8_t> bytes) {
  const Signal* found = find_signal(message_with(pgn), signal);
  assert(found != nullptr);
  return decode(*found, bytes);
}

}  // namespace earshot::n2k
