#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace splotchcl {

// The words of a formula: numbers, names, signs.
struct FormulaWord {
  enum class Kind { number, name, quoted_name, sign, end };
  Kind kind = Kind::end;
  std::string text;  // of a quoted name without the quotes; a sign as formulas write it, "&&"
  std::size_t begin = 0, end = 0;

  bool is_sign(std::string_view wanted) const { return kind == Kind::sign && text == wanted; }
};

// The last one is the end. Throws UsageError, which `what` begins, for what is no word of a
// formula.
std::vector<FormulaWord> words_of_formula(const std::string& text, const std::string& what);

}  // namespace splotchcl
