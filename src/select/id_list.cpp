#include "select/id_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "common/mapped_file.h"
#include "common/words.h"
#include "select/whole_number.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::uint64_t parse_id(const std::string& text, const std::filesystem::path& path,
                       std::size_t line) {
  if (const auto id = whole_number(text)) return *id;
  constexpr std::size_t longest = 40;
  throw DataError(fmt::format(
      "{}:{}: found \"{}\"{}, expected one identifier on each line, a whole number "
      "from 0 to 2^64 - 1 (numpy.savetxt writes them with fmt=\"%d\")",
      path.string(), line, text.substr(0, longest), text.size() > longest ? "..." : ""));
}

}  // namespace

void refuse_mask(const std::vector<std::uint64_t>& ids, const std::filesystem::path& path) {
  const auto zeros = std::count(ids.begin(), ids.end(), 0U);
  const auto ones = std::count(ids.begin(), ids.end(), 1U);
  const bool is_mask = static_cast<std::size_t>(zeros + ones) == ids.size() && ids.size() > 2;
  if (!is_mask) return;
  throw DataError(fmt::format(
      "{}: found a mask, {} zeros and {} ones, expected the identifiers of the particles that are "
      "wanted; save ids[mask] instead",
      path.string(), zeros, ones));
}

std::vector<std::uint64_t> read_id_list(const std::filesystem::path& path) {
  const auto file = MappedFile::open(path);
  std::string_view rest(reinterpret_cast<const char*>(file->data()), file->size());
  std::vector<std::uint64_t> ids;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const std::string text = trimmed(std::string(line.substr(0, line.find('#'))));
    if (!text.empty()) ids.push_back(parse_id(text, path, number));
  }
  if (ids.empty()) {
    throw DataError(path.string() + ": found no identifier, expected one on each line");
  }
  refuse_mask(ids, path);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace splotchcl
