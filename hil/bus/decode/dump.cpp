#include "hil/bus/decode/dump.hpp"

#include <ostream>

namespace earshot::hil {

bool Dump::take(const LogEntry& entry) {
  Heard heard;
  const Decoder::Taken taken = decoder_.accept(entry, heard);
  if (taken == Decoder::Taken::kTooManyInterfaces) return false;
  if (recording_ != nullptr && entry.frame) recording_->add(entry);
  if (taken != Decoder::Taken::kMessage) return true;
  const bool is_of_group = shown_.pgns.empty() || shown_.pgns.contains(heard.identifier.pgn);
  if (is_of_group && (!shown_.source || *shown_.source == heard.identifier.source)) printer_.print(out_, heard);
  return true;
}

}  // namespace earshot::hil
