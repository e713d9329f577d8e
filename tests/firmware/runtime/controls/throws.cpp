// Positive control of the symbol check: it must be found out.
void refuse() {
  throw 1;
}
