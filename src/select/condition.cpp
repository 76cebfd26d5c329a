#include "select/condition.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/words.h"
#include "select/whole_number.h"

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

template <typename Number>
bool compare(Operator op, Number value, Number number) {
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

std::optional<Comparison> parse_comparison(const std::string& text) {
  const std::size_t place = text.find_first_of(operator_characters);
  if (place == std::string::npos) return std::nullopt;
  Comparison comparison;
  comparison.field = trimmed(text.substr(0, place));
  if (comparison.field.empty() || begins_with_joint(comparison.field)) return std::nullopt;
  for (const auto& [symbol, op] : operators) {
    const std::string spelled = symbol;
    if (text.compare(place, spelled.size(), spelled) != 0) continue;
    const std::string right = trimmed(text.substr(place + spelled.size()));
    const auto number = parse_number(right);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    comparison.op = op;
    comparison.number = *number;
    comparison.whole = whole_number(right);
    return comparison;
  }
  return std::nullopt;
}

}  // namespace

const char* const condition_form =
    "a condition such as \"temperature > 1e6\" or \"density >= 3 and mass < 1\" (or with or), or "
    "an "
    "array of "
    "conditions that all must hold, each with <, <=, >, >=, == or != between a field and a number";

bool Comparison::holds(double value) const {
  return !std::isnan(value) && compare(op, value, number);
}

bool Comparison::holds_for_id(std::uint64_t id) const {
  return whole && compare(op, id, *whole);
}

std::optional<Condition> parse_condition(const std::string& text) {
  Condition condition;
  for (const std::string& part : split_at(text, " or ")) {
    Conjunction all;
    for (const std::string& one : split_at(part, " and ")) {
      const auto comparison = parse_comparison(one);
      if (!comparison) return std::nullopt;
      all.push_back(*comparison);
    }
    condition.push_back(std::move(all));
  }
  return condition;
}

}  // namespace splotchcl
