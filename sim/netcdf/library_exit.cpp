#include "sim/netcdf/library_exit.hpp"

#include <H5public.h>

namespace earshot::netcdf {

void leave_hdf5_alone_at_exit() {
  static const int asked = H5dont_atexit();  // once: HDF5 refuses it after its first use
  (void)asked;
}

}  // namespace earshot::netcdf
