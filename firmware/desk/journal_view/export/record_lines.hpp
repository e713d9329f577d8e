#pragma once

#include <cstdint>
#include <filesystem>

#include "firmware/desk/journal_view/export/export.hpp"

namespace earshot::journal {

inline constexpr host::OutputKind kRecordLinesOutput{"a file of a journal's records", {"{\"number\":", {}}};

/// Every record as a JSON object on a line of its own: {"number":..., "time_s":..., "channel":..., "fields":{...}}. One that cannot be read
/// has null for its fields.
class RecordLines final : public Export {
 public:
  explicit RecordLines(const std::filesystem::path& path) : file_(path) {}
  void take(const Entry& entry, std::span<const Event> events) override;
  void finish(std::span<const Event> /*events*/) override { file_.commit(); }
  [[nodiscard]] std::string what() const override;

 private:
  PiecewiseFile file_;
  std::uint64_t records_ = 0;
};

}  // namespace earshot::journal
