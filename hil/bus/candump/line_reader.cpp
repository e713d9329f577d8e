#include "hil/bus/candump/line_reader.hpp"

#include <utility>

namespace earshot::hil {

bool LineReader::next(TextLine& line) {
  const std::size_t end = piece_.find('\n');
  const bool is_whole = end != std::string_view::npos;
  const std::string_view part = piece_.substr(0, end);
  is_too_long_ = is_too_long_ || begun_.size() + part.size() > kMostBytes;
  if (is_too_long_) {
    begun_.clear();
  } else {
    begun_ += part;
  }
  piece_.remove_prefix(is_whole ? end + 1 : piece_.size());
  if (!is_whole && (!is_at_end_ || (begun_.empty() && !is_too_long_))) return false;
  whole_ = std::exchange(begun_, {});
  line = {.text = whole_, .is_too_long = std::exchange(is_too_long_, false)};
  return true;
}

}  // namespace earshot::hil
