#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

// What a system is asked that POSIX has no answer to. Nothing, 0 or an empty text: not known.
namespace splotchcl::of_system {

// Bytes that programs, and this one's group of them, may still take.
std::optional<std::uint64_t> memory_left();
// Bytes of address space that this process has taken.
std::optional<std::uint64_t> address_space_in_use();
// How many of the machine's cores this process may use.
std::optional<int> allowed_cores();

// When a process began, in a unit of the system's own: another one of that number began at another
// time.
std::uint64_t start_of_process(pid_t process);
// Whether it has ended and only its number is left, as long as its parent does not ask how it
// ended; in containers often for ever.
bool is_only_number(pid_t process);
// The same for processes whose numbers are of one kind: those of a container, of a machine.
std::string process_space();
std::string machine_identity();

// The file, as an absolute path, whose code or data lies at this address.
std::filesystem::path file_around(const void* address);
// What to start for another process of this program.
std::filesystem::path own_program();

// Bytes that nobody guesses; whether there are any.
bool fill_with_chance(void* bytes, std::size_t count);

// Two ends that children do not inherit, connected both ways or from the second to the first.
// Returns whether there are, with errno, as the calls of POSIX.
bool connect_ends(int (&ends)[2]);
bool open_pipe(int (&ends)[2]);
// As ::send, but no signal comes where the other end is gone.
ssize_t send_without_signal(int socket, const void* bytes, std::size_t count, int flags);
// Takes back a signal of a broken pipe that this thread has blocked.
void drop_pipe_signal();

// When a file was last written to.
timespec written_at(const struct stat& file);

}  // namespace splotchcl::of_system
