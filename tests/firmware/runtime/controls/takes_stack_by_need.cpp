// Positive control of the call check: it must be found out.
void fill(void* bytes);

void take(unsigned size) {
  fill(__builtin_alloca(size));
}
