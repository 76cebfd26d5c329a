#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

// A dataset of rows, one row per particle, or a part of each row: a member of its records, a
// column.
struct Hdf5Dataset {
  enum class Kind { integer, real, records, other };
  std::string path;                 // in the file
  std::vector<std::string> member;  // from the records to what is in them; empty: the whole row
  std::vector<hsize_t> shape;       // that of a member that is an array follows the dataset's
  Kind kind = Kind::other;
  std::size_t bytes_per_value = 0;
  bool is_signed = false;
  bool has_axes_first = false;          // of shape (3, N): a row is what is in one column
  std::optional<std::uint64_t> column;  // the only one that counts

  std::string label() const;
  // The path, and what of it.
  std::string name() const;
  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
  bool is_as_stored() const { return member.empty() && !has_axes_first && !column; }
  std::uint64_t rows() const;
  std::uint64_t values_per_row() const { return column ? 1 : stored_values_per_row(); }
  std::uint64_t stored_values_per_row() const;
  bool is_double() const { return kind == Kind::real && bytes_per_value > 4; }
  // Whether single precision has every value that it may hold.
  bool is_single_precision() const {
    return kind == Kind::real ? !is_double() : bytes_per_value <= 2;
  }
};

}  // namespace splotchcl
