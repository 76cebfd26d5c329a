#include "common/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "common/guards.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(const std::filesystem::path& path)
      // Without O_NONBLOCK a pipe would be waited for.
      : value_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~FileDescriptor() {
    if (value_ >= 0) ::close(value_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

struct stat status_of(const FileDescriptor& file, const std::filesystem::path& path) {
  if (file.value() < 0) {
    throw DataError(fmt::format("{}: cannot be opened: {}; check the path and its permissions",
                                path.string(), std::strerror(errno)));
  }
  struct stat status = {};
  if (::fstat(file.value(), &status) != 0) {
    throw DataError(fmt::format("{}: its size cannot be found: {}; check the file system",
                                path.string(), std::strerror(errno)));
  }
  if (!S_ISREG(status.st_mode)) {
    throw DataError(fmt::format("{}: not a regular file; give the path of a file", path.string()));
  }
  return status;
}

}  // namespace

void require_regular_file(const std::filesystem::path& path) {
  (void)status_of(FileDescriptor(path), path);
}

std::shared_ptr<const MappedFile> MappedFile::open(const std::filesystem::path& path) {
  const FileDescriptor file(path);
  const struct stat status = status_of(file, path);
  const auto size = static_cast<std::uint64_t>(status.st_size);
  std::shared_ptr<MappedFile> mapped(new MappedFile(path, size));
  mapped->device_ = status.st_dev;
  mapped->node_ = status.st_ino;
  if (size > 0) {  // a mapping of length 0 is an error
    void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.value(), 0);
    if (memory == MAP_FAILED) {
      throw DataError(fmt::format(
          "{}: {} bytes cannot be mapped: {}; check the limit on address space (ulimit -v)",
          path.string(), size, std::strerror(errno)));
    }
    mapped->data_ = static_cast<const std::byte*>(memory);
    register_mapping(mapped->data_, size, mapped->path_.c_str());
  }
  return mapped;
}

void MappedFile::check_size() const {
  struct stat status = {};
  const bool is_same = unpacked_.empty() && ::stat(path_.c_str(), &status) == 0 &&
                       status.st_dev == device_ && status.st_ino == node_;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const bool is_cut_now = is_same && size < size_;
  if (!is_cut_now && (data_ == nullptr || !is_cut(data_))) return;
  if (!is_cut_now) {
    throw DataError(path_.string() +
                    ": became shorter while it was read, and is another file now; read it again");
  }
  throw DataError(
      fmt::format("{}: became shorter while it was read: found {} bytes, expected {}; wait until "
                  "it is completely written and try again",
                  path_.string(), size, size_));
}

std::shared_ptr<const MappedFile> MappedFile::open_if_possible(const std::filesystem::path& path) {
  try {
    return open(path);
  } catch (const DataError&) {
    return nullptr;
  }
}

std::shared_ptr<const MappedFile> MappedFile::of_bytes(const std::filesystem::path& path,
                                                       std::vector<std::byte> bytes) {
  std::shared_ptr<MappedFile> file(new MappedFile(path, bytes.size()));
  file->unpacked_ = std::move(bytes);
  file->data_ = file->unpacked_.data();
  return file;
}

MappedFile::~MappedFile() {
  if (data_ == nullptr || !unpacked_.empty()) return;
  forget_mapping(data_);
  ::munmap(const_cast<std::byte*>(data_), size_);
}

bool is_another_file(const std::filesystem::path& path, const FileMark& mark) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return false;
  if (!std::filesystem::is_regular_file(path, ignored)) return true;
  const auto file = MappedFile::open_if_possible(path);
  if (file == nullptr) return true;  // nobody knows
  const auto there = static_cast<std::size_t>(std::min<std::uint64_t>(file->size(), mark.size()));
  return there > 0 && std::memcmp(file->data(), mark.data(), there) != 0;
}

namespace {

constexpr std::uint64_t largest_text_file = 16 * 1024 * 1024;

}  // namespace

std::string_view text_of(const MappedFile& file) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (file.size() == 0) return {};
  std::string_view text(reinterpret_cast<const char*>(file.data()),
                        static_cast<std::size_t>(file.size()));
  const bool has_mark = text.substr(0, byte_order_mark.size()) == byte_order_mark;
  return has_mark ? text.substr(byte_order_mark.size()) : text;
}

std::string read_text_file(const std::filesystem::path& path) {
  const auto file = MappedFile::open(path);
  if (file->size() > largest_text_file) {
    throw DataError(fmt::format("{}: found {} bytes, expected a text file of at most {}",
                                path.string(), file->size(), largest_text_file));
  }
  return std::string(text_of(*file));
}

}  // namespace splotchcl
