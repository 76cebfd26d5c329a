#include "common/file_identity.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <ctime>
#include <vector>

#include "common/words.h"
#include "scene/hash.h"
#include "splotchcl/error.h"
#include "system/system.h"

namespace splotchcl {
namespace {

constexpr std::int64_t ns_in_second = 1'000'000'000;

// Read, not mapped: the file may become shorter meanwhile. Returns the error's number, or 0.
int add_stretch(int descriptor, std::uint64_t begin, std::uint64_t end, WordHash& hash) {
  std::vector<std::byte> bytes(std::size_t{1} << 16);
  while (begin < end) {
    const auto wanted =
        static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), end - begin));
    const ::ssize_t count = ::pread(descriptor, bytes.data(), wanted, static_cast<::off_t>(begin));
    if (count < 0) return errno;
    if (count == 0) return 0;
    hash.add(checksum(bytes.data(), static_cast<std::size_t>(count)));
    begin += static_cast<std::uint64_t>(count);
  }
  return 0;
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error) {
  throw DataError(path.string() + ": cannot be read: " + reason(error));
}

}  // namespace

bool operator==(const FileIdentity& a, const FileIdentity& b) {
  return a.device == b.device && a.node == b.node && a.bytes == b.bytes &&
         a.written_ns == b.written_ns;
}

std::optional<FileIdentity> file_identity(const std::filesystem::path& path) {
  struct stat found = {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  FileIdentity identity;
  identity.device = static_cast<std::uint64_t>(found.st_dev);
  identity.node = static_cast<std::uint64_t>(found.st_ino);
  identity.bytes = static_cast<std::uint64_t>(found.st_size);
  const timespec written = of_system::written_at(found);
  identity.written_ns = ns_in_second * written.tv_sec + written.tv_nsec;
  return identity;
}

std::string describe(const std::optional<FileIdentity>& file) {
  if (!file) return "no file";
  std::int64_t seconds = file->written_ns / ns_in_second, ns = file->written_ns % ns_in_second;
  if (ns < 0) {
    ns += ns_in_second;
    --seconds;
  }
  return fmt::format("{} bytes, written {:%Y-%m-%d %H:%M:%S}.{:09} UTC", file->bytes,
                     fmt::gmtime(static_cast<std::time_t>(seconds)), ns);
}

std::uint64_t content_mark(const std::filesystem::path& path) {
  constexpr std::uint64_t all_up_to = std::uint64_t{16} << 20, stretches = 64,
                          stretch = std::uint64_t{1} << 16;
  const std::optional<FileIdentity> file = file_identity(path);
  // Without O_NONBLOCK a pipe that has taken its place would be waited for.
  const int descriptor = file ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK) : -1;
  if (!file) return 0;
  if (descriptor < 0) fail_to_read(path, errno);
  WordHash hash;
  int error = 0;
  if (file->bytes <= all_up_to) {
    error = add_stretch(descriptor, 0, file->bytes, hash);
  } else {
    for (std::uint64_t i = 0; i < stretches && error == 0; ++i) {
      const std::uint64_t begin = (file->bytes - stretch) / (stretches - 1) * i;
      error = add_stretch(descriptor, begin, begin + stretch, hash);
    }
  }
  ::close(descriptor);
  if (error != 0) fail_to_read(path, error);
  return hash.value();
}

void WatchedFiles::add(const std::filesystem::path& file) {
  if (const std::optional<FileIdentity> found = file_identity(file)) files_.emplace(file, *found);
}

void WatchedFiles::check(const std::filesystem::path& file, const FileIdentity& expected,
                         const std::optional<FileIdentity>& found) {
  if (found && *found == expected) return;
  const bool differs_in_place =
      found && found->bytes == expected.bytes && found->written_ns == expected.written_ns;
  throw DataError(fmt::format(
      "{}: changed while it was used: found {}{}, expected {}; draw again what was drawn of it",
      file.string(), differs_in_place ? "another file of " : "", describe(found),
      describe(expected)));
}

void WatchedFiles::check() const {
  for (const auto& [file, expected] : files_)
    check(file, expected, file_identity(file));
}

void WatchedFiles::check_in_place() const {
  for (const auto& [file, expected] : files_) {
    const std::optional<FileIdentity> found = file_identity(file);
    const bool is_in_place =
        found && found->device == expected.device && found->node == expected.node;
    if (is_in_place) check(file, expected, found);
  }
}

std::uint64_t ContentMarks::of(const std::filesystem::path& path) {
  const auto known = known_.find(path);
  return known != known_.end() ? known->second
                               : known_.emplace(path, content_mark(path)).first->second;
}

}  // namespace splotchcl
