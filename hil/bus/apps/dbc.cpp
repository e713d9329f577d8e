#include <iostream>
#include <string_view>

#include "hil/bus/dbc.hpp"

int main(int argc, char** argv) {
  if (argc == 1) {
    earshot::hil::print_dbc(std::cout);
    return std::cout.good() ? 0 : 1;
  }
  const bool help = argc == 2 && (std::string_view(argv[1]) == "--help" || std::string_view(argv[1]) == "-h");
  (help ? std::cout : std::cerr) << "Usage: earshot dbc\n\n"
                                    "Prints the CAN messages that Earshot reads and writes (NMEA 2000 parameter groups) as a DBC file,\n"
                                    "for cantools, SavvyCAN and other tools: earshot dbc > earshot.dbc\n";
  return help ? 0 : 2;
}
