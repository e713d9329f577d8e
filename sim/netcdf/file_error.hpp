#pragma once

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::netcdf {

/// What is wrong with a NetCDF file, one line: "FILE: VARIABLE: reason". Programs treat it as the bad input it is: exit status 2.
class FileError : public host::BadInput {
 public:
  using host::BadInput::BadInput;
};

}  // namespace earshot::netcdf
