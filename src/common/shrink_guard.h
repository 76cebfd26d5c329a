#pragma once

#include <cstddef>
#include <cstdint>

namespace splotchcl {

// A program that reads memory of a mapped file which another program has made shorter gets the
// signal SIGBUS, wherever it may be: in a kernel, in a library, in any thread. No exception can
// come out of there. With the guard the program ends with one line that names the file and with
// exit code 1, instead of "Bus error". Call it once, from main: signals are the program's, not a
// library's.
void guard_mapped_files();

// What the guard knows: mapped memory and the name of its file, which must stay as long. Signal
// handlers can only look at global data. Beyond a thousand mapped files there is no guard.
void register_mapping(const std::byte* begin, std::uint64_t size, const char* path);
void forget_mapping(const std::byte* begin);

}  // namespace splotchcl
