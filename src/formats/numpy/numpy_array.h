#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/mapped_file.h"
#include "formats/stored_values.h"

namespace splotchcl {

// A member of a structured array's records, or what a plain array is made of.
struct NumpyMember {
  std::string name;  // empty in a plain array
  ValueKind kind = ValueKind::float32;
  bool is_swapped = false;
  bool is_usable = false;    // a number of a kind that is read
  bool is_truth = false;     // of values that are true or false
  bool is_object = false;    // of Python, whatever it is
  std::uint64_t offset = 0;  // in the record
  std::uint64_t values = 1;  // more for members that are arrays
  std::uint64_t bytes = 0;   // of one value
};

// The header of an array in NumPy's format (.npy, versions 1 to 3).
struct NumpyHeader {
  std::vector<NumpyMember> members;
  bool is_structured = false;
  bool is_fortran_order = false;
  // Whether values are objects of Python: what lies in the file is then their pickle.
  bool is_pickled = false;
  std::vector<std::uint64_t> shape;  // empty: a single value
  std::uint64_t record_bytes = 0;
  std::uint64_t data_offset = 0;

  std::uint64_t rows() const { return shape.empty() ? 1 : shape.front(); }
};

bool is_numpy_array(const std::byte* data, std::uint64_t size);

// Reads a header from the first bytes of an array; `name` is for messages. `file_size` is that
// of the whole array, which must be what its shape needs (a pickle has any). Throws DataError.
NumpyHeader read_numpy_header(const std::byte* data, std::uint64_t size, std::uint64_t file_size,
                              const std::string& name);

// Whether a file is an array of NumPy (.npy), by its first bytes. Throws DataError.
bool is_numpy_file(const std::filesystem::path& path);

// The whole numbers of an array of one dimension, in a file of its own. Throws DataError for any
// other.
std::vector<std::uint64_t> read_numpy_integers(const std::filesystem::path& path);

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
