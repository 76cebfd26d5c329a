#include "io/common/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(const std::filesystem::path& path)
      : value_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~FileDescriptor() {
    if (value_ >= 0) ::close(value_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

}  // namespace

std::shared_ptr<const MappedFile> MappedFile::open(const std::filesystem::path& path) {
  const FileDescriptor file(path);
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
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const std::byte* data = nullptr;
  if (size > 0) {  // a mapping of length 0 is an error
    void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.value(), 0);
    if (memory == MAP_FAILED) {
      throw DataError(fmt::format(
          "{}: {} bytes cannot be mapped: {}; check the limit on address space (ulimit -v)",
          path.string(), size, std::strerror(errno)));
    }
    data = static_cast<const std::byte*>(memory);
  }
  return std::shared_ptr<const MappedFile>(new MappedFile(path, data, size));
}

std::shared_ptr<const MappedFile> MappedFile::of_bytes(const std::filesystem::path& path,
                                                       std::vector<std::byte> bytes) {
  std::shared_ptr<MappedFile> file(new MappedFile(path, nullptr, bytes.size()));
  file->unpacked_ = std::move(bytes);
  file->data_ = file->unpacked_.data();
  return file;
}

MappedFile::~MappedFile() {
  if (data_ != nullptr && unpacked_.empty()) ::munmap(const_cast<std::byte*>(data_), size_);
}

}  // namespace splotchcl
