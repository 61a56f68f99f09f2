// CLN, on which GiNaC stands, forgets a string of 26 bytes when it is loaded; GiNaC forgets the
// parts of a derivative that turns out to have a pole, 72 bytes each time.

extern "C" const char* __lsan_default_suppressions();   // NOLINT: the sanitizer's name
extern "C" const char* __lsan_default_suppressions() {  // NOLINT
  return "leak:libcln\nleak:GiNaC::power::derivative\n";
}
