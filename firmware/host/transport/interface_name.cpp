#include "firmware/host/transport/interface_name.hpp"

#include <net/if.h>

#include <string_view>

namespace earshot::host {

bool is_interface_name(std::string_view name) {
  constexpr std::string_view kRefused("/: \t\n\v\f\r\xA0\0", 10);
  return !name.empty() && name.size() < IFNAMSIZ && name != "." && name != ".." && name.find_first_of(kRefused) == std::string_view::npos;
}

}  // namespace earshot::host
