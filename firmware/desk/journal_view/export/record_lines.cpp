#include "firmware/desk/journal_view/export/record_lines.hpp"

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::journal {

void RecordLines::take(const Entry& entry, std::span<const Event> /*events*/) {
  const auto* const record = std::get_if<Record>(&entry);
  if (record == nullptr) return;
  ++records_;
  const nlohmann::ordered_json line{{"number", record->number},
                                    {"time_s", seconds_of(record->time)},
                                    {"channel", record->channel},
                                    {"topic", topic_of(record->content)},
                                    {"fields", fields_of(record->content)}};
  file_.write(to_line(line) + "\n");
}

std::string RecordLines::what() const {
  return host::counted(records_, "record");
}

}  // namespace earshot::journal
