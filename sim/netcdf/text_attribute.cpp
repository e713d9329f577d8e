#include "sim/netcdf/text_attribute.hpp"

#include <netcdf.h>

#include <cstddef>

namespace earshot::netcdf {
namespace {

std::optional<std::string> string_of(int file, int variable, const char* attribute) {
  char* text = nullptr;
  if (nc_get_att_string(file, variable, attribute, &text) != NC_NOERR) return std::nullopt;
  const std::string copy = text != nullptr ? text : "";
  (void)nc_free_string(1, &text);
  return copy;
}

}  // namespace

std::optional<std::string> text_attribute(int file, int variable, const char* attribute) {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file, variable, attribute, &type, &length) != NC_NOERR) return std::nullopt;
  if (type == NC_STRING && length == 1) return string_of(file, variable, attribute);
  if (type != NC_CHAR) return std::nullopt;
  std::string text(length, '\0');
  if (nc_get_att_text(file, variable, attribute, text.data()) != NC_NOERR) return std::nullopt;
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

}  // namespace earshot::netcdf
