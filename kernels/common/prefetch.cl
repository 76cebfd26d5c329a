// Memory that will be needed soon, asked for early, is there when it is. OpenCL's own prefetch()
// does nothing on PoCL, and cannot ask for memory that is written to.
// HAS_PREFETCH: a processor's compiler that has clang's builtin (program_text.cpp).
#ifdef HAS_PREFETCH
#define ask_for(place) __builtin_prefetch((const void*)(size_t)(place))
#define ask_to_write(place) __builtin_prefetch((const void*)(size_t)(place), 1)
#else
#define ask_for(place)
#define ask_to_write(place)
#endif
// Numbers of four bytes: as many as a line of the cache has; and so far ahead they are asked for
// where they are read one after the other, which not every processor sees, or early enough.
#define NUMBERS_OF_LINE 16
#define NUMBERS_AHEAD 512
