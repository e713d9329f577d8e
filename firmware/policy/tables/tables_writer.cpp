#include <span>

#include "firmware/policy/envelope/byte_stream.hpp"
#include "firmware/policy/tables/tables_format.hpp"

namespace earshot::policy {
namespace {

using namespace format;

constexpr std::size_t kGridSize = 7 * sizeof(double) + sizeof(std::uint16_t);

void write(ByteWriter& writer, DepthRange depths) {
  writer.f64(depths.least.value);
  writer.f64(depths.most.value);
}

void write_grid(ByteWriter& writer, const OceanTables& tables) {
  writer.f64(tables.frequency.value);
  writer.f64(tables.receiver_depth.value);
  write(writer, tables.source_depth);
  write(writer, tables.sea_depth);
  writer.f64(tables.range_step.value);
  writer.u16(tables.range_count);
}

void write_oceans(ByteWriter& writer, const OceanTables& tables) {
  writer.u16(static_cast<std::uint16_t>(tables.tables.size()));
  for (const OceanTable& table : tables.tables) {
    writer.u8(static_cast<std::uint8_t>(table.name.size()));
    for (const char character : table.name) writer.u8(static_cast<std::uint8_t>(character));
    writer.f32(table.prior);
    writer.f32(table.sea_depth_m);
    for (const std::int8_t snr : std::span(table.snr_half_db).first(tables.range_count)) writer.u8(static_cast<std::uint8_t>(snr));
  }
}

void write_content(ByteWriter& writer, const OceanTables& tables, TablesContent content) {
  switch (content) {
    case TablesContent::kGrid:
      return write_grid(writer, tables);
    case TablesContent::kOceans:
      return write_oceans(writer, tables);
    case TablesContent::kProvenance:
      return write_provenance(writer, tables.provenance);
  }
}

}  // namespace

std::size_t max_tables_size() {
  constexpr std::size_t kTable = 1 + config::kMaxTableName + 2 * sizeof(float) + config::kMaxTableRanges;
  constexpr std::size_t kOceans = sizeof(std::uint16_t) + config::kMaxOceanTables * kTable;
  return size_around(kTablesFile, kGridSize + kOceans + config::kMaxProvenance);
}

Result<std::size_t> serialise(const OceanTables& tables, std::span<const std::uint8_t, kPublicKeySize> public_key,
                              std::span<std::uint8_t> bytes) {
  if (!has_valid_shape(tables) || !has_valid_numbers(tables)) return Status::kOutOfRange;
  return write_file(kTablesFile, public_key, bytes,
                    [&tables](ByteWriter& writer, std::size_t index) { write_content(writer, tables, static_cast<TablesContent>(index)); });
}

}  // namespace earshot::policy
