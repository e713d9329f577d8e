#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace earshot::freeze {

/// Walks the fields of one protobuf message in its wire format. Throws host::BadInput for bytes that are none.
/// Source: protobuf.dev, "Encoding". Groups, which no current schema uses, are refused.
class ProtobufReader {
 public:
  enum class Wire : std::uint8_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };
  struct Field {
    std::uint32_t number = 0;
    Wire wire = Wire::kVarint;
    std::uint64_t value = 0;  ///< of kVarint, kFixed64, kFixed32
    std::string_view bytes;   ///< of kBytes; of kFixed32 and kFixed64 as they stand
  };

  explicit ProtobufReader(std::string_view message) : rest_(message) {}
  /// Nothing at the end.
  [[nodiscard]] std::optional<Field> next();
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] std::uint64_t varint();

 private:
  std::string_view take(std::uint64_t size);
  std::string_view rest_;
};

/// The content of a field that is a text. Throws host::BadInput for a number.
[[nodiscard]] std::string text_of(const ProtobufReader::Field& field);

/// The texts of fields 1 and 2, key and value: an entry of a map from text to text.
[[nodiscard]] std::pair<std::string, std::string> text_pair_of(std::string_view message);

}  // namespace earshot::freeze
