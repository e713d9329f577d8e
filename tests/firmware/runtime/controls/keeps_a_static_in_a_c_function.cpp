// Positive control of the state check: it must be found out. Its name is "calls.0" and tells nothing.
extern "C" int count() {
  static int calls = 0;
  return ++calls;
}
