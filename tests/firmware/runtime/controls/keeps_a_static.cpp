// Positive control of the state check: it must be found out.
int make();

int count() {
  static int from = make();
  return ++from;
}
