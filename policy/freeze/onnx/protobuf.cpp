#include "policy/freeze/onnx/protobuf.hpp"

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::freeze {

using host::BadInput;

std::optional<ProtobufReader::Field> ProtobufReader::next() {
  if (rest_.empty()) return std::nullopt;
  const std::uint64_t key = varint();
  Field field{.number = static_cast<std::uint32_t>(key >> 3U), .wire = static_cast<Wire>(key & 7U), .value = 0, .bytes = {}};
  if (field.number == 0 || (key >> 3U) > 0x1FFF'FFFFU) throw BadInput("protobuf: a field without a number");
  switch (field.wire) {
    case Wire::kVarint:
      field.value = varint();
      return field;
    case Wire::kBytes:
      field.bytes = take(varint());
      return field;
    case Wire::kFixed32:
    case Wire::kFixed64:
      field.bytes = take(field.wire == Wire::kFixed32 ? 4 : 8);
      for (std::size_t i = field.bytes.size(); i-- > 0;) field.value = (field.value << 8U) | static_cast<std::uint8_t>(field.bytes[i]);
      return field;
  }
  throw BadInput("protobuf: a field of unknown kind");
}

std::uint64_t ProtobufReader::varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const auto byte = static_cast<std::uint8_t>(take(1)[0]);
    value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) return value;
  }
  throw BadInput("protobuf: a number that does not end");
}

std::string_view ProtobufReader::take(std::uint64_t size) {
  if (size > rest_.size()) throw BadInput("protobuf: cut short");
  const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
  rest_.remove_prefix(taken.size());
  return taken;
}

std::string text_of(const ProtobufReader::Field& field) {
  if (field.wire != ProtobufReader::Wire::kBytes) throw BadInput("protobuf: a text that is a number");
  return std::string(field.bytes);
}

std::pair<std::string, std::string> text_pair_of(std::string_view message) {
  std::pair<std::string, std::string> texts;
  ProtobufReader reader(message);
  while (const auto field = reader.next()) {
    if (field->number == 1) texts.first = text_of(*field);
    if (field->number == 2) texts.second = text_of(*field);
  }
  return texts;
}

}  // namespace earshot::freeze
