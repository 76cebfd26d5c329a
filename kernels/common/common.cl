// Formulas that several stages share. The host puts a block of #defines in front of each program
// (src/device/frame/variant.cpp).
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
