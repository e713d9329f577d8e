// The functions of libsndfile by which sim/recording reads, each of which loads the library when it is first called. Linked before
// libsndfile, they take its place: the wheel then imports where it and the codecs behind it are not installed, and reads no sound files
// there.
#include <sndfile.h>

#include <array>

#include "policy/python/late/late_library.hpp"

namespace {

using earshot::python::LateLibrary;

constexpr std::array kNames{"libsndfile.so.1"};
constexpr LateLibrary kSndfile(kNames, "a sound file cannot be read: libsndfile is not installed: sudo apt install libsndfile1");

}  // namespace

EARSHOT_LATE(kSndfile, int, sf_close, (SNDFILE * file), (file))
EARSHOT_LATE(kSndfile, const char*, sf_get_string, (SNDFILE * file, int which), (file, which))
EARSHOT_LATE(kSndfile, SNDFILE*, sf_open, (const char* path, int mode, SF_INFO* info), (path, mode, info))
EARSHOT_LATE(kSndfile, SNDFILE*, sf_open_virtual, (SF_VIRTUAL_IO * io, int mode, SF_INFO* info, void* user), (io, mode, info, user))
EARSHOT_LATE(kSndfile, sf_count_t, sf_readf_float, (SNDFILE * file, float* into, sf_count_t frames), (file, into, frames))
EARSHOT_LATE(kSndfile, sf_count_t, sf_seek, (SNDFILE * file, sf_count_t frames, int whence), (file, frames, whence))
EARSHOT_LATE(kSndfile, const char*, sf_strerror, (SNDFILE * file), (file))
