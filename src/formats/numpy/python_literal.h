#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splotchcl {

// What Python writes for texts, whole numbers, True and False, and for tuples, lists and
// dictionaries of them: the headers of NumPy's arrays.
struct PythonLiteral {
  enum class Kind { text, integer, boolean, sequence, dictionary };
  Kind kind = Kind::text;
  std::string text;
  std::uint64_t integer = 0;
  bool is_true = false;
  std::vector<PythonLiteral> items;                            // of a tuple or list
  std::vector<std::pair<std::string, PythonLiteral>> entries;  // of a dictionary

  const PythonLiteral* find(std::string_view key) const;  // null where there is none
};

// None where the text is nothing of that, or nested deeper than any header is.
std::optional<PythonLiteral> parse_python_literal(std::string_view text);

}  // namespace splotchcl
