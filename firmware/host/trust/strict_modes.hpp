#pragma once

#include <filesystem>
#include <vector>

namespace earshot::host {

/// Whether nobody but root and the user that this program runs as can change these files, as sshd's StrictModes asks it of its own: each
/// file, and every folder and link on the way to it from the root on, belongs to one of the two, and neither its group nor others may write
/// it. (Who owns the root folder counts as root, as in a container whose root has another number.) Files may be missing; their folders are
/// judged. Unlike sshd, which looks no further than a home folder, this looks up to the root; so a folder on the way may be written by
/// others if its sticky bit is set, as /tmp's is: there nobody renames or removes what is another's.
/// @param files  not empty; the first one begins the complaint
/// @throws BadInput naming everything that is wrong at once, and the chmod and chown that mend it
/// Oracle: StrictModes.*
void require_strict_modes(const std::vector<std::filesystem::path>& files);

}  // namespace earshot::host
