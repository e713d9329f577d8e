#pragma once

#include <iosfwd>

namespace earshot::hil {

/// Prints the signal table of firmware/wire/n2k as a DBC file, so that cantools, SavvyCAN and their like can name what they see on the bus.
/// Identifiers carry the default priority and the addresses of Earshot and of the simulated vehicle, since some tools (cantools) compare
/// whole identifiers; others match by PGN (VFrameFormat J1939PG). Raw values that are no numbers have names.
/// Oracle: dbc.is_up_to_date; dbc.is_read_by_cantools
void print_dbc(std::ostream& out);

}  // namespace earshot::hil
