#pragma once

#include <string>

namespace earshot::host {

/// A process of this machine, for a person: "earshot-fly (process 4711)".
[[nodiscard]] std::string name_of_process(const std::string& number);

}  // namespace earshot::host
