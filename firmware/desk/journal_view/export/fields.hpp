#pragma once

#include <nlohmann/json.hpp>

#include "firmware/host/journal/reading/entry.hpp"

namespace earshot::journal {

/// What a record says as a JSON object: the fields of its message by name, their units in the names, SI throughout; times in seconds on the
/// mission's clock (at sea: since 1970, UTC). States, orders and the like are words. A number that is not known is NaN, which JSON writes
/// as null. Null for a record that cannot be read.
[[nodiscard]] nlohmann::ordered_json fields_of(const Content& content);

/// The same of a record of that kind that says all that one may: nothing is missing, and each list holds an element. For a schema.
[[nodiscard]] nlohmann::ordered_json all_fields_of(const Content& content);

/// A short name of what a record says: "navigation", "health"; "unknown" for one that cannot be read.
[[nodiscard]] const char* topic_of(const Content& content);

/// JSON on one line. Bytes of a text that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string to_line(const nlohmann::ordered_json& json);

}  // namespace earshot::journal
