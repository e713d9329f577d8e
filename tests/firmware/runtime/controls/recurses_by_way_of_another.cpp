// Positive control of the call check: it must be found out.
bool is_odd(unsigned n);

[[gnu::noinline]] bool is_even(unsigned n) {
  return n == 0 || is_odd(n - 1);
}

[[gnu::noinline]] bool is_odd(unsigned n) {
  return n != 0 && is_even(n - 1);
}
