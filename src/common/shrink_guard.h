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

// For a module of a program that must not end: what is no longer there of a mapped file reads as
// zeros from then on, and whoever reads asks afterwards whether that has happened. Signals of other
// memory go where they went before.
void survive_cut_files();
// How often it has happened in this process, and the file of the last time; null: none.
std::uint64_t cut_file_count();
const char* last_cut_file();
// Whether it has happened to this mapping.
bool is_cut(const std::byte* begin);

// What the guard knows: mapped memory and the name of its file, which must stay as long. Signal
// handlers can only look at global data. Beyond a thousand mapped files there is no guard.
void register_mapping(const std::byte* begin, std::uint64_t size, const char* path);
void forget_mapping(const std::byte* begin);

}  // namespace splotchcl
