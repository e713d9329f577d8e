// The functions of the NetCDF library by which sim/netcdf reads, each of which loads the library when it is first called. Linked before
// libnetcdf, they take its place: the wheel then imports where NetCDF, HDF5 and the forty libraries behind them are not installed, and
// reads no charts there.
#include <H5public.h>
#include <netcdf.h>

#include <array>

#include "policy/python/late/late_library.hpp"

namespace {

using earshot::python::LateLibrary;

// Of Debian 12 and of today; what is called of them is the same in both. HDF5's function is found through NetCDF, which is built on it.
constexpr std::array kNames{"libnetcdf.so.19", "libnetcdf.so.22"};
constexpr LateLibrary kNetcdf(kNames, "a NetCDF file cannot be read: libnetcdf is not installed: sudo apt install libnetcdf19");

}  // namespace

EARSHOT_LATE(kNetcdf, int, H5dont_atexit, (), ())
EARSHOT_LATE(kNetcdf, int, nc_close, (int file), (file))
EARSHOT_LATE(kNetcdf, int, nc_free_string, (size_t count, char** texts), (count, texts))
EARSHOT_LATE(kNetcdf, int, nc_get_att_double, (int file, int id, const char* name, double* value), (file, id, name, value))
EARSHOT_LATE(kNetcdf, int, nc_get_att_string, (int file, int id, const char* name, char** value), (file, id, name, value))
EARSHOT_LATE(kNetcdf, int, nc_get_att_text, (int file, int id, const char* name, char* value), (file, id, name, value))
EARSHOT_LATE(kNetcdf, int, nc_get_vara_double, (int file, int id, const size_t* start, const size_t* count, double* values),
             (file, id, start, count, values))
EARSHOT_LATE(kNetcdf, int, nc_inq_att, (int file, int id, const char* name, nc_type* type, size_t* length), (file, id, name, type, length))
EARSHOT_LATE(kNetcdf, int, nc_inq_attname, (int file, int id, int number, char* name), (file, id, number, name))
EARSHOT_LATE(kNetcdf, int, nc_inq_atttype, (int file, int id, const char* name, nc_type* type), (file, id, name, type))
EARSHOT_LATE(kNetcdf, int, nc_inq_dimlen, (int file, int id, size_t* length), (file, id, length))
EARSHOT_LATE(kNetcdf, int, nc_inq_dimname, (int file, int id, char* name), (file, id, name))
EARSHOT_LATE(kNetcdf, int, nc_inq_nvars, (int file, int* count), (file, count))
EARSHOT_LATE(kNetcdf, int, nc_inq_var, (int file, int id, char* name, nc_type* type, int* rank, int* dimensions, int* attributes),
             (file, id, name, type, rank, dimensions, attributes))
EARSHOT_LATE(kNetcdf, int, nc_inq_varid, (int file, const char* name, int* id), (file, name, id))
EARSHOT_LATE(kNetcdf, int, nc_inq_varnatts, (int file, int id, int* count), (file, id, count))
EARSHOT_LATE(kNetcdf, int, nc_inq_vartype, (int file, int id, nc_type* type), (file, id, type))
EARSHOT_LATE(kNetcdf, int, nc_open, (const char* path, int mode, int* file), (path, mode, file))
EARSHOT_LATE(kNetcdf, const char*, nc_strerror, (int status), (status))
