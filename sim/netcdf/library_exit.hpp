#pragma once

namespace earshot::netcdf {

/// To be called before the first use of the NetCDF library: keeps HDF5 from tidying up when the program ends. After a disk has filled, its
/// tidying up dereferences a file it failed to close, and a program that had reported the error dies of SIGSEGV instead of exit status 2
/// (seen with HDF5 1.10.8 under NetCDF 4.9.0). Files that were closed need none of it.
/// Oracle: NetcdfWriter.LetsAProgramEndInPeaceAfterAFullDisk
void leave_hdf5_alone_at_exit();

}  // namespace earshot::netcdf
