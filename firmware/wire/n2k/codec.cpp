#include "firmware/wire/n2k/codec.hpp"

#include <algorithm>
#include <cassert>

#include "firmware/wire/n2k/text.hpp"

namespace earshot::n2k {

namespace {

const Message& message_with(std::uint32_t pgn) {
  const Message* message = find_message(pgn);
  assert(message != nullptr);
  return *message;
}

}  // namespace

MessageWriter::MessageWriter(std::uint32_t pgn) : MessageWriter(message_with(pgn)) {}

MessageWriter& MessageWriter::remember(Status status) {
  if (status_ == Status::kOk) status_ = status;
  return *this;
}

MessageWriter& MessageWriter::set(FieldName signal, double value) {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  return remember(encode(*found, value, bytes_));
}

MessageWriter& MessageWriter::set_raw(FieldName signal, std::int64_t raw) {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  return remember(encode_raw(*found, raw, bytes_));
}

MessageWriter& MessageWriter::set_text(FieldName signal, std::string_view text) {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  return remember(write_fixed_text(*found, text, bytes_));
}

Status MessageWriter::frame(std::uint8_t source, Frame& frame, std::uint8_t destination) const {
  if (message_.size > frame.data.size()) return Status::kOutOfRange;
  const Result<std::uint32_t> id = compose(identifier(source, destination));
  if (status_ != Status::kOk) return status_;
  if (!id.ok()) return id.status();
  frame.identifier = id.value();
  frame.size = message_.size;
  frame.data = {};
  for (std::size_t i = 0; i < frame.size; ++i) frame.data[i] = bytes_[i];
  return Status::kOk;
}

template <class T>
T MessageReader::remember(const Result<T>& result) {
  if (status_ == Status::kOk) status_ = result.status();
  return status_ == Status::kOk ? result.value() : T{};
}

double MessageReader::value(FieldName signal) {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  return remember(decode(*found, bytes_));
}

Result<double> MessageReader::decode_of(FieldName signal) const {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  return decode(*found, bytes_);
}

std::optional<double> MessageReader::value_if_any(FieldName signal) const {
  const Result<double> decoded = decode_of(signal);
  return decoded.ok() ? std::optional(decoded.value()) : std::nullopt;
}

std::optional<std::int64_t> MessageReader::raw_if_any(FieldName signal) const {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  const Result<std::int64_t> decoded = decode_raw(*found, bytes_);
  return decoded.ok() ? std::optional(decoded.value()) : std::nullopt;
}

std::int64_t MessageReader::raw(FieldName signal) {
  const Signal* found = find_signal(message_, signal);
  assert(found != nullptr);
  return remember(decode_raw(*found, bytes_));
}

Result<double> read(std::uint32_t pgn, FieldName signal, std::span<const std::uint8_t> bytes) {
  const Signal* found = find_signal(message_with(pgn), signal);
  assert(found != nullptr);
  return decode(*found, bytes);
}

}  // namespace earshot::n2k
