#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

// "field op number"
struct Comparison {
  enum class Operator { less, at_most, more, at_least, equal, not_equal };
  std::string field;
  Operator op = Operator::less;
  double number = 0;
  // The same, exact, where it is one that an identifier may have.
  std::optional<std::uint64_t> whole;

  // False for a value that is not a number, also for not_equal.
  bool holds(double value) const;
  // Against `whole`, which it needs.
  bool holds_for_id(std::uint64_t id) const;
};

// Holds where all of its comparisons do.
using Conjunction = std::vector<Comparison>;
// Holds where any of its parts does.
using Condition = std::vector<Conjunction>;

// Comparisons joined by the words "and" and "or", of which "and" binds more closely; nothing when
// the text is no condition.
std::optional<Condition> parse_condition(const std::string& text);

// Completes "expected ...".
extern const char* const condition_form;

// The identifiers of a text file, one on a line, in increasing order and each once. Blank
// lines, and what follows a '#', do not count. Throws DataError for a file that cannot be
// read, a line that is not a whole number from 0 to 2^64 - 1, and a file without any. Numbers as
// NumPy's savetxt writes them, 1.2e+01, are taken as far as they are exact.
std::vector<std::uint64_t> read_id_list(const std::filesystem::path& path);

// Throws DataError for what is no list of identifiers but says of each particle whether it is
// wanted: nothing but 0 and 1, several times.
void refuse_mask(const std::vector<std::uint64_t>& ids, const std::filesystem::path& path);

}  // namespace splotchcl
