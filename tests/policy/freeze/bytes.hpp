#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace earshot::freeze::test {

/// A file of tests/policy/freeze/models (made by tests/oracles/freeze/make_models.py).
[[nodiscard]] std::string model(const std::string& name);
[[nodiscard]] nlohmann::json model_oracle();

/// A zip archive with these entries.
[[nodiscard]] std::string zip_of(const std::map<std::string, std::string>& entries);
/// Every entry of a zip archive.
[[nodiscard]] std::map<std::string, std::string> unzipped(const std::string& archive);

/// What `action` threw, which must be host::BadInput; "" when it threw nothing.
template <class Action>
[[nodiscard]] std::string refusal(Action action);

/// In [0, 1), 16 bits: the function `uniform` of tests/oracles/freeze/uniform.py.
[[nodiscard]] double uniform(std::uint32_t stream, std::uint32_t i);

}  // namespace earshot::freeze::test

#include "firmware/host/toml/table_reader.hpp"

template <class Action>
std::string earshot::freeze::test::refusal(Action action) {
  try {
    action();
    return "";
  } catch (const host::BadInput& e) {
    return e.what();
  }
}
