// How kernels call functions, take pieces of work and ask for memory early. The host puts a block
// of #defines in front of each program (src/device/frame/variant.cpp).
#pragma OPENCL FP_CONTRACT ON

// Where a call would cost: PoCL leaves functions of some length as calls, and their structures
// in memory.
#ifndef INLINED  // scripts/test_icd has another for a simulator
#define INLINED __attribute__((always_inline)) static inline
#endif

// Found when the program is compiled.
#define REQUIRE(what, condition) typedef char requires_##what[(condition) ? 1 : -1]

// What hardly any lane needs: a call on processors, where it would take registers from what all of
// them need. GPUs' compilers would put the structures that a call is handed in memory of each
// work-item's own, and keep registers for it.
#ifdef LANES_8
#define SELDOM_CALLED __attribute__((noinline)) static
#else
#define SELDOM_CALLED INLINED
#endif

// What a kernel does for a work-item, whose numbers it is handed. Of a kernel PoCL makes three
// copies for processors, and puts into them whatever asks for such a number itself: with a call in
// it, it is compiled in half the time. Elsewhere a call would cost.
#ifdef CALLS_BODIES
#define KERNEL_BODY __attribute__((noinline)) static
#else
#define KERNEL_BODY INLINED
#endif

// Of functions that there are for eight numbers and for sixteen.
#if ROWS_OF_16
#define OVERLOADED __attribute__((overloadable))
#else
#define OVERLOADED
#endif

// Pieces of work on a processor, each for one work-item. A runtime may hand half of all items to
// one thread at once, and the other thread, or a faster core, takes none of these over. So a piece
// comes with several items (Launch::run_pieces), of which only the first has work to do.
#define NO_PIECE 0xffffffffu

static inline uint piece_of_item(uint pieces) {
  const uint items = (uint)get_global_size(0) / pieces, item = (uint)get_global_id(0);
  return item % items == 0 ? item / items : NO_PIECE;
}

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
