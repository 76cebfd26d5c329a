#pragma once

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

  // False for a value that is not a number, also for not_equal.
  bool holds(double value) const;
};

// Holds where any of its comparisons does.
using Condition = std::vector<Comparison>;

// Comparisons joined by the word "or"; nothing when the text is no condition.
std::optional<Condition> parse_condition(const std::string& text);

// Completes "expected ...".
extern const char* const condition_form;

}  // namespace splotchcl
