#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace splotchcl {

// A zip archive opened for reading. Everything throws DataError, with libzip's reason.
class ZipArchive {
 public:
  struct Entry {
    std::string name;
    std::uint64_t index = 0;
    std::uint64_t bytes = 0;  // unpacked, as the archive says
  };

  explicit ZipArchive(const std::filesystem::path& path);

  const std::vector<Entry>& entries() const { return entries_; }
  // The first bytes of an entry, unpacked; fewer where it is shorter.
  std::vector<std::byte> read(const Entry& entry, std::uint64_t bytes) const;

 private:
  struct Close {
    void operator()(void* archive) const;
  };

  std::filesystem::path path_;
  std::unique_ptr<void, Close> archive_;
  std::vector<Entry> entries_;
};

}  // namespace splotchcl
