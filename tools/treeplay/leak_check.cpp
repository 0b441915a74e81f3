// The leak checker of a sanitizer build is off in this program: graphics drivers keep what they allocate when
// they start, unload themselves before the checker could tell whose it was, and it crashes on their threads.
// What the libraries below allocate is checked in every other program.
#ifdef __SANITIZE_ADDRESS__
extern "C" int __lsan_is_turned_off();  // NOLINT(bugprone-reserved-identifier): the checker asks by this name
extern "C" int __lsan_is_turned_off() {  // NOLINT(bugprone-reserved-identifier)
  return 1;
}
#endif
