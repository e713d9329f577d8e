#pragma once

#include <netcdf.h>

#include "sim/netcdf/writer.hpp"

namespace earshot::netcdf {

/// The NetCDF library's own number for a type of ours.
[[nodiscard]] inline nc_type nc_type_of(Type type) {
  switch (type) {
    case Type::kFloat:
      return NC_FLOAT;
    case Type::kDouble:
      return NC_DOUBLE;
    case Type::kInt16:
      return NC_SHORT;
    case Type::kInt32:
      return NC_INT;
  }
  return NC_NAT;
}

}  // namespace earshot::netcdf
