#pragma once

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "sim/netcdf/header.hpp"

namespace earshot::tests {

/// Every unit that a file states is one of UDUNITS, as the CF conventions want it. Oracle: its own program, udunits2.
inline void expect_known_units(const std::filesystem::path& path) {
  int file = -1;
  ASSERT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file), NC_NOERR) << path;
  int units = 0;
  for (const auto& [name, variable] : netcdf::read_header(file)) {
    const auto unit = variable.texts.find("units");
    if (unit == variable.texts.end()) continue;
    ++units;
    const std::string command = "udunits2 -H '" + unit->second + "' -W '" + unit->second + "' >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << path << ": " << name << ": "
                                               << unit->second;  // NOLINT(concurrency-mt-unsafe): one thread
  }
  EXPECT_GT(units, 0) << path;
  (void)nc_close(file);
}

}  // namespace earshot::tests
