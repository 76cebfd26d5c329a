#include "formats/numpy/numpy_integers.h"

#include <fmt/format.h>

#include <utility>

#include "formats/numpy/numpy_array.h"
#include "splotchcl/error.h"

namespace splotchcl {

bool is_numpy_file(const std::filesystem::path& path) {
  const auto file = MappedFile::open(path);
  return is_numpy_array(file->data(), file->size());
}

std::vector<std::uint64_t> read_numpy_integers(const std::filesystem::path& path) {
  const auto file = MappedFile::open(path);
  const NumpyHeader header =
      read_numpy_header(file->data(), file->size(), file->size(), path.string());
  const NumpyMember& values = header.members.front();
  if (values.is_truth) {
    throw DataError(path.string() +
                    ": found a mask of true and false, expected the identifiers of the particles "
                    "that are wanted; save ids[mask] instead");
  }
  const bool is_list = !header.is_structured && values.is_usable && header.shape.size() == 1;
  if (is_list) {
    StoredValues stored;
    stored.file = file;
    stored.offset = header.data_offset;
    stored.particles = header.rows();
    stored.kind = values.kind;
    stored.is_swapped = values.is_swapped;
    if (auto numbers = make_integers({stored})) return std::move(*numbers);
  }
  throw DataError(fmt::format(
      "{}: not an array of whole numbers in one dimension, as was expected; save it as such, for "
      "example with numpy.save(name, ids.astype(\"u8\").ravel())",
      path.string()));
}

}  // namespace splotchcl
