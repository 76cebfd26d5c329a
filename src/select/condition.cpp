#include "select/condition.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/words.h"

namespace splotchcl {
namespace {

using Operator = Comparison::Operator;

// Those of two characters first: "<=" begins with "<".
constexpr std::array<std::pair<const char*, Operator>, 6> operators = {{
    {"<=", Operator::at_most},
    {">=", Operator::at_least},
    {"==", Operator::equal},
    {"!=", Operator::not_equal},
    {"<", Operator::less},
    {">", Operator::more},
}};

constexpr const char* operator_characters = "<>=!";

std::optional<Comparison> parse_comparison(const std::string& text) {
  const std::size_t place = text.find_first_of(operator_characters);
  if (place == std::string::npos) return std::nullopt;
  Comparison comparison;
  comparison.field = trimmed(text.substr(0, place));
  // A word that joins what is not there.
  if (comparison.field.empty() || comparison.field.compare(0, 3, "or ") == 0) return std::nullopt;
  for (const auto& [symbol, op] : operators) {
    const std::string spelled = symbol;
    if (text.compare(place, spelled.size(), spelled) != 0) continue;
    const auto number = parse_number(trimmed(text.substr(place + spelled.size())));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    comparison.op = op;
    comparison.number = *number;
    return comparison;
  }
  return std::nullopt;
}

}  // namespace

const char* const condition_form =
    "a condition such as \"temperature > 1e6\" or \"density >= 3 or mass < 1\", or an array of "
    "conditions that all must hold, each with <, <=, >, >=, == or != between a field and a number";

bool Comparison::holds(double value) const {
  if (std::isnan(value)) return false;
  switch (op) {
    case Operator::less:
      return value < number;
    case Operator::at_most:
      return value <= number;
    case Operator::more:
      return value > number;
    case Operator::at_least:
      return value >= number;
    case Operator::equal:
      return value == number;
    case Operator::not_equal:
      return value != number;
  }
  return false;
}

std::optional<Condition> parse_condition(const std::string& text) {
  const std::string word = " or ";
  Condition condition;
  for (std::size_t begin = 0; begin != std::string::npos;) {
    const std::size_t end = text.find(word, begin);
    const auto comparison = parse_comparison(
        text.substr(begin, end == std::string::npos ? std::string::npos : end - begin));
    if (!comparison) return std::nullopt;
    condition.push_back(*comparison);
    begin = end == std::string::npos ? end : end + word.size();
  }
  return condition;
}

}  // namespace splotchcl
