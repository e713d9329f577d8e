#pragma once

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "sim/netcdf/header.hpp"

namespace earshot::tests {

inline std::string text_of(const netcdf::Variable& variable, const std::string& attribute) {
  const auto found = variable.texts.find(attribute);
  return found != variable.texts.end() ? found->second : "";
}

inline std::size_t words_in(const std::string& text) {
  std::istringstream stream(text);
  std::size_t count = 0;
  for (std::string word; stream >> word;) ++count;
  return count;
}

/// CF 1.11, 3.1: UDUNITS knows the unit. Oracle: its own program, udunits2. A level's unit also stands there in words.
inline void expect_known_unit(const std::string& name, const netcdf::Variable& variable) {
  const std::string unit = text_of(variable, "units");
  const std::string command = "udunits2 -H '" + unit + "' -W '" + unit + "' >/dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << name << ": " << unit;  // NOLINT(concurrency-mt-unsafe): one thread
  const std::string words = text_of(variable, "level_unit");
  EXPECT_EQ(unit.starts_with("0.1 lg(re "), words.starts_with("dB")) << name << ": " << unit << ", " << words;
  EXPECT_TRUE(text_of(variable, "long_name").ends_with(words)) << name;
}

/// CF 1.11, 3.5: as many flag_values as flag_meanings, of the variable's type.
inline void expect_flags(int file, const std::string& name, const netcdf::Variable& variable) {
  int id = -1;
  nc_type type = NC_NAT;
  nc_type of_values = NC_NAT;
  std::size_t values = 0;
  ASSERT_EQ(nc_inq_varid(file, name.c_str(), &id), NC_NOERR) << name;
  ASSERT_EQ(nc_inq_vartype(file, id, &type), NC_NOERR) << name;
  ASSERT_EQ(nc_inq_att(file, id, "flag_values", &of_values, &values), NC_NOERR) << name;
  EXPECT_EQ(of_values, type) << name;
  EXPECT_EQ(values, words_in(text_of(variable, "flag_meanings"))) << name;
}

/// A file that a program wrote keeps to what CF 1.11 asks of its attributes; tests/sim/netcdf/conventions/run has all that a public checker
/// asks. @param path  of a file with a level or more
inline void expect_kept_conventions(const std::filesystem::path& path) {
  SCOPED_TRACE(path);
  int file = -1;
  ASSERT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file), NC_NOERR);
  std::string conventions(7, ' ');
  EXPECT_EQ(nc_get_att_text(file, NC_GLOBAL, "Conventions", conventions.data()), NC_NOERR);
  EXPECT_EQ(conventions, "CF-1.11");
  int levels = 0;
  const netcdf::Header header = netcdf::read_header(file);
  for (const auto& [name, variable] : header) {
    if (variable.texts.contains("level_unit")) ++levels;
    if (variable.texts.contains("units")) expect_known_unit(name, variable);
    if (variable.texts.contains("flag_meanings")) expect_flags(file, name, variable);
    for (const char* const naming : {"coordinates", "bounds", "grid_mapping"}) {
      std::istringstream named(text_of(variable, naming));
      for (std::string other; named >> other;) EXPECT_TRUE(header.contains(other)) << name << ": " << naming << ": " << other;
    }
    if (name == "time") {  // CF 1.11, 4.4: it counts since a date
      EXPECT_EQ(text_of(variable, "standard_name"), "time");
      EXPECT_NE(text_of(variable, "units").find(" since "), std::string::npos);
    }
  }
  EXPECT_GT(levels, 0);
  (void)nc_close(file);
}

}  // namespace earshot::tests
