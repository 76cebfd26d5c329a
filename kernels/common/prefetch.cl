// Memory that will be needed soon, asked for early, is there when it is. OpenCL's own prefetch()
// does nothing on PoCL, and cannot ask for memory that is written to.
#if defined(__clang__) && !defined(NO_PREFETCH)  // scripts/test_icd: a simulator has none
#define ask_for(place) __builtin_prefetch((const void*)(size_t)(place))
#define ask_to_write(place) __builtin_prefetch((const void*)(size_t)(place), 1)
#else
#define ask_for(place)
#define ask_to_write(place)
#endif
