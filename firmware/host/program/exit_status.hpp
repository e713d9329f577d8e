#pragma once

namespace earshot::program {

inline constexpr int kDone = 0;
/// Done with what there was: something is missing or damaged, which standard error says.
inline constexpr int kIncomplete = 1;
/// The command line or a file was refused; nothing was done.
inline constexpr int kBadInput = 2;
/// Something went wrong on the way that was not the input's fault: another process, a bus, a file.
inline constexpr int kLost = 3;
/// A search ended in ABORT: a rule of the safety supervisor, an operator, or a memory that failed ended it. (earshotd)
inline constexpr int kAborted = 4;
/// A signal stopped a search under way, which that ended in ABORT, too. (earshotd)
inline constexpr int kInterrupted = 5;
/// Ctrl-C or SIGTERM, as a shell counts: 128 and SIGINT's number.
inline constexpr int kStopped = 130;

}  // namespace earshot::program
