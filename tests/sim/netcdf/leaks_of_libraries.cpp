// HDF5 keeps memory at exit, because leave_hdf5_alone_at_exit() stops its tidying up; files that could not be closed for a full disk
// besides. Read by LeakSanitizer, without effect where there is none.
extern "C" const char* __lsan_default_suppressions();

extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5\n";
}
