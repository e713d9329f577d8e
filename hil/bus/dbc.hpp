#pragma once

#include <iosfwd>

namespace earshot::hil {

/// Prints the signal table of firmware/wire/n2k as a DBC file, so that cantools, SavvyCAN and their like can name what they see on the bus.
/// Identifiers carry the default priority and the null source address 254: tools match them by PGN (VFrameFormat J1939PG).
/// Oracle: dbc.is_up_to_date; read back with cantools (README.md)
void print_dbc(std::ostream& out);

}  // namespace earshot::hil
