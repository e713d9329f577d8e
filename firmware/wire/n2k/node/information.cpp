#include "firmware/wire/n2k/node/information.hpp"

#include <array>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/text.hpp"

namespace earshot::n2k {

namespace {

constexpr std::int64_t kNetworkVersion = 2100;  ///< 2.100: thousandths
constexpr std::int64_t kNotCertified = table::raw_of(table::kCertificationLevel, "Level B");
constexpr std::size_t kLongestConfiguration = 70;

struct Pgns {
  std::array<std::uint32_t, kMostListedPgns> pgns{};
  std::size_t size = 0;
};

consteval bool is_listed(const Message& message, PgnListKind kind) {
  if (message.direction == Direction::kBoth) return true;
  return (message.direction == Direction::kFromRuntime) == (kind == PgnListKind::kTransmitted);
}

consteval Pgns pgns_of(PgnListKind kind) {
  Pgns listed;
  for (const Message& message : table::kMessages) {
    bool is_new = is_listed(message, kind);
    for (std::size_t i = 0; i < listed.size; ++i) is_new = is_new && listed.pgns[i] != message.pgn;
    if (is_new) listed.pgns[listed.size++] = message.pgn;
  }
  return listed;
}

constexpr Pgns kTransmitted = pgns_of(PgnListKind::kTransmitted);
constexpr Pgns kReceived = pgns_of(PgnListKind::kReceived);

Result<Information> copy_of(std::span<const std::uint8_t> bytes) {
  Information information;
  for (const std::uint8_t byte : bytes) {
    if (information.push_back(byte) != Status::kOk) return Status::kFull;
  }
  return information;
}

}  // namespace

Result<Information> product_information(const Product& product) {
  MessageWriter writer(table::kProduct);
  writer.set_raw("NMEA2000Version", kNetworkVersion)
      .set_raw("ProductCode", product.code)
      .set_text("ModelID", product.model)
      .set_text("SoftwareVersionCode", product.software_version)
      .set_text("ModelVersion", product.model_version)
      .set_text("ModelSerialCode", product.serial)
      .set_raw("CertificationLevel", kNotCertified)
      .set_raw("LoadEquivalency", product.load_equivalency);
  if (writer.status() != Status::kOk) return writer.status();
  return copy_of(writer.bytes());
}

Result<Information> configuration_information(const Configuration& configuration) {
  std::array<std::uint8_t, kMaxMessageSize> bytes{};
  std::span<std::uint8_t> room = bytes;
  for (const std::string_view text : {configuration.installation_1, configuration.installation_2, configuration.manufacturer}) {
    if (text.size() > kLongestConfiguration) return Status::kOutOfRange;
    const Status status = put_variable_text(text, room);
    if (status != Status::kOk) return status;
  }
  return copy_of(std::span(bytes).first(bytes.size() - room.size()));
}

Result<Information> pgn_list(PgnListKind kind, std::span<const std::uint32_t> pgns) {
  if (pgns.size() > kMostListedPgns) return Status::kOutOfRange;
  Information information;
  static_cast<void>(information.push_back(static_cast<std::uint8_t>(kind)));
  for (const std::uint32_t pgn : pgns) {
    if (pgn > 0x3FFFFU) return Status::kOutOfRange;
    for (const unsigned shift : {0U, 8U, 16U}) static_cast<void>(information.push_back(static_cast<std::uint8_t>(pgn >> shift)));
  }
  return information;
}

std::span<const std::uint32_t> table_pgns(PgnListKind kind) {
  const Pgns& listed = kind == PgnListKind::kTransmitted ? kTransmitted : kReceived;
  return {listed.pgns.data(), listed.size};
}

}  // namespace earshot::n2k
