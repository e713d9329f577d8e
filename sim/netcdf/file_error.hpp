#pragma once

#include "firmware/config_file/table_reader.hpp"

namespace earshot::netcdf {

/// What is wrong with a NetCDF file, one line: "FILE: VARIABLE: reason". Programs treat it as the bad input it is: exit status 2.
class FileError : public config_file::BadInput {
 public:
  using config_file::BadInput::BadInput;
};

}  // namespace earshot::netcdf
