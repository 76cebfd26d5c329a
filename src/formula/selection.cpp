#include "formula/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "common/mapped_file.h"
#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr const char* operator_characters = "<>=!";

// A word that joins what is not there.
bool begins_with_joint(const std::string& text) {
  return text.compare(0, 3, "or ") == 0 || text.compare(0, 4, "and ") == 0;
}

// The parts of a text between a word.
std::vector<std::string> split_at(const std::string& text, const std::string& word) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(word, begin);
    if (end == std::string::npos) {
      parts.push_back(text.substr(begin));
      return parts;
    }
    parts.push_back(text.substr(begin, end - begin));
    begin = end + word.size();
  }
}

// A whole number from 0 to 2^64 - 1, exact. One with a point or an exponent, as far as double
// precision has all whole numbers; else nothing.
std::optional<std::uint64_t> whole_number(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && rest == end) return number;
  if (text.find_first_of(".eE") == std::string::npos) return std::nullopt;
  constexpr double largest = 9007199254740992.0;
  const auto real = parse_number(text);
  const bool is_whole = real && *real >= 0 && *real < largest && *real == std::floor(*real);
  return is_whole ? std::optional(static_cast<std::uint64_t>(*real)) : std::nullopt;
}

// "`field` op number"; nothing for what is none.
std::optional<std::string> with_quoted_name(const std::string& comparison) {
  const std::size_t place = comparison.find_first_of(operator_characters);
  if (place == std::string::npos) return std::nullopt;
  const std::string field = trimmed(comparison.substr(0, place));
  const bool is_name =
      !field.empty() && !begins_with_joint(field) && field.find('`') == std::string::npos;
  const std::size_t behind = comparison.find_first_not_of(operator_characters, place);
  if (!is_name || behind == std::string::npos) return std::nullopt;
  const auto number = parse_number(trimmed(comparison.substr(behind)));
  if (!number || !std::isfinite(*number)) return std::nullopt;
  return "`" + field + "`" + comparison.substr(place);
}

std::optional<std::string> with_quoted_names(const std::string& text) {
  std::string any;
  for (const std::string& part : split_at(text, " or ")) {
    std::string all;
    for (const std::string& one : split_at(part, " and ")) {
      const auto comparison = with_quoted_name(one);
      if (!comparison) return std::nullopt;
      all += (all.empty() ? "" : " && ") + *comparison;
    }
    any += (any.empty() ? "" : " || ") + all;
  }
  return any;
}

}  // namespace

const char* const condition_form =
    "a condition such as \"temperature > 1e6\" or \"density >= 3 && mass < 1\", or an array of "
    "conditions that all must hold";

std::optional<Formula> parse_comparisons(const std::string& text) {
  const std::optional<std::string> quoted = with_quoted_names(text);
  if (!quoted) return std::nullopt;
  try {
    return Formula::parse(*quoted, "condition");
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

Formula parse_condition(const std::string& text, const std::string& what) {
  try {
    const Formula formula = Formula::parse(text, what);
    if (formula.is_condition()) return formula;
  } catch (const UsageError&) {
    if (auto comparisons = parse_comparisons(text)) return std::move(*comparisons);
    throw;
  }
  throw UsageError(
      fmt::format("{}: found the number \"{}\", expected {}", what, text, condition_form));
}

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
  std::string_view rest = text_of(*file);
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
