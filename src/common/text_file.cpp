#include "common/text_file.h"

#include <fmt/format.h>

#include <cstdint>

#include "common/mapped_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::uint64_t largest_text_file = 16 * 1024 * 1024;

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
  const auto file = MappedFile::open(path);
  if (file->size() > largest_text_file) {
    throw DataError(fmt::format("{}: found {} bytes, expected a text file of at most {}",
                                path.string(), file->size(), largest_text_file));
  }
  if (file->size() == 0) return "";
  return std::string(reinterpret_cast<const char*>(file->data()),
                     static_cast<std::size_t>(file->size()));
}

}  // namespace splotchcl
