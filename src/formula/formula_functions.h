#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

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
