#pragma once

#include <cstddef>
#include <optional>
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

// What a function makes of the unit of its arguments.
enum class FunctionUnit { none, same, square_root, cube_root };

struct FormulaFunction {
  const char* name;
  double (*of_one)(double);          // null: of two
  double (*of_two)(double, double);  // null: of one
  FunctionUnit unit;

  std::size_t arguments() const { return of_one != nullptr ? 1 : 2; }
};

// All that formulas have.
const std::vector<FormulaFunction>& formula_functions();
std::optional<std::size_t> find_formula_function(const std::string& name);
std::vector<std::string> names_of_formula_functions();

}  // namespace splotchcl
