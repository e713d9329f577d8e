// Positive control of the call check: it must be found out. The optimiser could make a loop of it.
int factorial(int n) {
  return n <= 1 ? 1 : n * factorial(n - 1);
}
