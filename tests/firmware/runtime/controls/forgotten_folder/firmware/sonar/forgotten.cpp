// Positive control of the call check: it must be found out. It is of the core, but no library that is looked at holds it.
int forgotten() {
  return 1;
}
