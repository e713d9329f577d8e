// Positive control of the symbol check: it must be found out.
int* allocate() {
  return new int(1);
}
