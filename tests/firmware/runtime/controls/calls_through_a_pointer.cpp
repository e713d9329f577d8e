// Positive control of the call check: it must be found out.
int call(int (*anything)(int), int with) {
  return anything(with) + 1;
}
