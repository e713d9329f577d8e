// Positive control of the call check: it must be found out.
void fill(void* bytes);

void take() {
  char bytes[65'536];
  fill(bytes);
}
