#include "select/id_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <string>

#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::uint64_t parse_id(const std::string& text, const std::filesystem::path& path,
                       std::size_t line) {
  std::uint64_t id = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, id);
  if (error == std::errc() && rest == end) return id;
  constexpr std::size_t longest = 40;
  throw DataError(fmt::format(
      "{}:{}: found \"{}\"{}, expected one identifier on each line, a whole number "
      "from 0 to 2^64 - 1",
      path.string(), line, text.substr(0, longest), text.size() > longest ? "..." : ""));
}

}  // namespace

std::vector<std::uint64_t> read_id_list(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file(path);
  if (!file || !std::filesystem::is_regular_file(path, ignored)) {
    throw DataError(fmt::format(
        "{}: cannot be read, expected a text file of identifiers, one on a line; check the path",
        path.string()));
  }
  std::vector<std::uint64_t> ids;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const std::string text = trimmed(line.substr(0, line.find('#')));
    if (!text.empty()) ids.push_back(parse_id(text, path, number));
  }
  if (file.bad()) throw DataError(path.string() + ": reading failed; check the file");
  if (ids.empty()) {
    throw DataError(path.string() + ": found no identifier, expected one on each line");
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace splotchcl
