#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace splotchcl {

// Throws DataError when the file is missing, or is a FIFO, a device or a folder: libraries that
// open files by their names would wait for one, or never come to its end.
void require_regular_file(const std::filesystem::path& path);

// A file's bytes as read-only memory. Always held by shared_ptr, so that a Column may
// point straight into the file and keep it mapped for as long as it lives.
class MappedFile {
 public:
  // Throws DataError when the file is missing, not a regular file, or cannot be mapped.
  static std::shared_ptr<const MappedFile> open(const std::filesystem::path& path);

  // Null in place of DataError: of files that one can do without, such as someone else's caches.
  static std::shared_ptr<const MappedFile> open_if_possible(const std::filesystem::path& path);

  // A file's content that had to be unpacked, under the file's name.
  static std::shared_ptr<const MappedFile> of_bytes(const std::filesystem::path& path,
                                                    std::vector<std::byte> bytes);

  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::byte* data() const { return data_; }
  std::uint64_t size() const { return size_; }

  // Throws DataError when the file has become shorter than it was: the bytes at its end are
  // no longer there.
  void check_size() const;

 private:
  MappedFile(std::filesystem::path path, std::uint64_t size)
      : path_(std::move(path)), size_(size) {}

  std::filesystem::path path_;
  std::uint64_t size_ = 0;
  const std::byte* data_ = nullptr;
  // They tell the file from another one that took its name.
  ::dev_t device_ = 0;
  ::ino_t node_ = 0;
  std::vector<std::byte> unpacked_;  // instead of a mapping
};

// What a file of the program's own begins with.
using FileMark = std::array<char, 16>;

// Whether something is there that is not such a file, and must not be overwritten. One that has
// been cut is.
bool is_another_file(const std::filesystem::path& path, const FileMark& mark);

// What a file holds as text, without the mark that editors and spreadsheets begin UTF-8 with.
std::string_view text_of(const MappedFile& file);

// A small text file as a whole. Throws DataError when it cannot be read, or is so large
// that it is no text file of ours.
std::string read_text_file(const std::filesystem::path& path);

}  // namespace splotchcl
