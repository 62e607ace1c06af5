// Assimp forgets a few hundred bytes of a file whose reading it breaks off, which is most of what these tests give it:
// LeakSanitizer, where it is built in, is asked to pass over what Assimp's own code has taken. Our readers stay watched.
extern "C" const char* __lsan_default_suppressions();

extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp.so\n"; }
