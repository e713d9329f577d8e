#pragma once

#include <string>

namespace earshot::board {

/// What a port says to a person.
struct PortWords {
  /// Its name and address, in words that stay true while links come and go: "vehicle, LCM udpm://...".
  std::string label = {};
  /// What may change, or takes more words, after the label: "on lo, eth0".
  std::string details = {};
  /// What else a person should know at the end: what was lost where, and what to do about it; empty when there is nothing.
  std::string remark = {};
  /// What somebody else sent into a simulation, and what became of it; empty when nobody did. A quiet program says it, too.
  std::string strangers = {};

  /// "vehicle, LCM udpm://... on lo, eth0"
  [[nodiscard]] std::string description() const { return details.empty() ? label : label + " " + details; }
};

}  // namespace earshot::board
