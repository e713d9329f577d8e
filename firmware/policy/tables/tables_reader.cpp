#include <span>

#include "firmware/policy/envelope/byte_stream.hpp"
#include "firmware/policy/tables/tables_format.hpp"

namespace earshot::policy {
namespace {

using namespace format;

DepthRange read_depths(ByteReader& reader) {
  const double least = reader.f64();
  return {.least = Meters{least}, .most = Meters{reader.f64()}};
}

PolicyFault read_grid(ByteReader& reader, OceanTables& tables) {
  tables.frequency = Hertz{reader.f64()};
  tables.receiver_depth = Meters{reader.f64()};
  tables.source_depth = read_depths(reader);
  tables.sea_depth = read_depths(reader);
  tables.range_step = Meters{reader.f64()};
  tables.range_count = reader.u16();
  return tables.range_count <= config::kMaxTableRanges ? PolicyFault::kNone : PolicyFault::kBadShape;
}

PolicyFault read_name(ByteReader& reader, OceanTable& table) {
  const std::size_t size = reader.u8();
  for (std::size_t i = 0; i < size; ++i)
    if (table.name.push_back(static_cast<char>(reader.u8())) != Status::kOk) return PolicyFault::kBadShape;
  return PolicyFault::kNone;
}

PolicyFault read_oceans(ByteReader& reader, OceanTables& tables) {
  tables.tables.clear();
  const std::size_t count = reader.u16();
  for (std::size_t i = 0; i < count; ++i) {
    OceanTable table;
    if (const PolicyFault fault = read_name(reader, table); fault != PolicyFault::kNone) return fault;
    table.prior = reader.f32();
    table.sea_depth_m = reader.f32();
    for (std::int8_t& snr : std::span(table.snr_half_db).first(tables.range_count)) snr = static_cast<std::int8_t>(reader.u8());
    if (tables.tables.push_back(table) != Status::kOk) return PolicyFault::kBadShape;
  }
  return PolicyFault::kNone;
}

PolicyFault read_content(ByteReader& reader, TablesContent content, OceanTables& tables) {
  switch (content) {
    case TablesContent::kGrid:
      return read_grid(reader, tables);
    case TablesContent::kOceans:
      return read_oceans(reader, tables);
    case TablesContent::kProvenance:
      return read_provenance(reader, tables.provenance);
  }
  return PolicyFault::kUnknownSection;
}

/// Numbers of the grid that cannot be, or those of the oceans.
PolicyComplaint complaint_about_numbers(const OceanTables& tables) {
  if (!has_valid_shape(tables))
    return {.fault = PolicyFault::kBadShape, .section = tables.range_count == 0 ? kGridSection : kOceansSection};
  if (has_valid_numbers(tables)) return {};
  return {.fault = PolicyFault::kOutOfRange, .section = has_valid_grid(tables) ? kOceansSection : kGridSection};
}

}  // namespace

Status parse(std::span<const std::uint8_t> bytes, OceanTables& tables, PolicyComplaint& complaint) {
  complaint = read_file(bytes, kTablesFile, [&tables](ByteReader& content, std::size_t index) {
    return read_content(content, static_cast<TablesContent>(index), tables);
  });
  if (complaint.is_none()) complaint = complaint_about_numbers(tables);
  return status_of(complaint.fault);
}

}  // namespace earshot::policy
