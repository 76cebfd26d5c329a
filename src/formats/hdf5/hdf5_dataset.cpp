#include "formats/hdf5/hdf5_dataset.h"

#include <fmt/format.h>

namespace splotchcl {

std::string Hdf5Dataset::label() const {
  if (member.empty()) return path.substr(path.rfind('/') + 1);
  return fmt::format("{}", fmt::join(member, "."));
}

std::string Hdf5Dataset::name() const {
  std::string text = path;
  if (!member.empty()) text += ":" + label();
  if (column) text += ":" + std::to_string(*column);
  return text;
}

std::uint64_t Hdf5Dataset::rows() const {
  if (shape.empty()) return 1;
  return has_axes_first ? shape[1] : shape[0];
}

std::uint64_t Hdf5Dataset::stored_values_per_row() const {
  if (has_axes_first) return shape[0];
  std::uint64_t values = 1;
  for (std::size_t i = 1; i < shape.size(); ++i)
    values *= shape[i];
  return values;
}

}  // namespace splotchcl
