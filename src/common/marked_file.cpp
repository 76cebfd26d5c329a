#include "common/marked_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "common/mapped_file.h"

namespace splotchcl {

bool is_another_file(const std::filesystem::path& path, const FileMark& mark) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return false;
  if (!std::filesystem::is_regular_file(path, ignored)) return true;
  const auto file = MappedFile::open_if_possible(path);
  if (file == nullptr) return true;  // nobody knows
  const auto there = static_cast<std::size_t>(std::min<std::uint64_t>(file->size(), mark.size()));
  return there > 0 && std::memcmp(file->data(), mark.data(), there) != 0;
}

}  // namespace splotchcl
