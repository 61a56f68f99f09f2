// CLN, on which GiNaC stands, forgets a string of 26 bytes when it is loaded.

extern "C" const char* __lsan_default_suppressions();   // NOLINT: the sanitizer's name
extern "C" const char* __lsan_default_suppressions() {  // NOLINT
  return "leak:libcln\n";
}
