#include <iostream>

#include "firmware/host/program/run.hpp"
#include "hil/bus/dbc.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  program::CommandLine line("earshot dbc",
                            "Prints the CAN messages that Earshot reads and writes (NMEA 2000 parameter groups) as a DBC file,\n"
                            "for cantools, SavvyCAN and other tools: earshot dbc > earshot.dbc");
  return program::run(line, argc, argv, [] {
    hil::print_dbc(std::cout);
    return program::kDone;
  });
}
