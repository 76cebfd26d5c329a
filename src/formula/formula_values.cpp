#include "formula/formula_values.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "formula/formula_words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::size_t block = 1024;  // particles, whose fields stay in the processor's cache

double differ(double a, double b) {
  return !std::isnan(a) && !std::isnan(b) && a != b ? 1 : 0;
}

template <typename Number>
bool compare(Operation comparison, Number a, Number b) {
  switch (comparison) {
    case Operation::less:
      return a < b;
    case Operation::at_most:
      return a <= b;
    case Operation::more:
      return a > b;
    case Operation::at_least:
      return a >= b;
    case Operation::equal:
      return a == b;
    default:
      return a != b;
  }
}

// A number of a formula, and how large it is exactly where it is a whole one.
struct ComparedNumber {
  double value = 0;
  std::optional<std::uint64_t> size;
};

// Below 0, 0 or above 0 as the size is less than the number, that, or more.
int order_of(std::uint64_t size, double number) {
  constexpr double beyond_all = 18446744073709551616.0;  // 2^64
  if (number >= beyond_all) return -1;
  const auto whole = static_cast<std::uint64_t>(number);
  if (size != whole) return size < whole ? -1 : 1;
  return number > static_cast<double>(whole) ? -1 : 0;
}

// The same of whole numbers with a sign; no double has them all.
int order_of(std::uint64_t value, bool is_signed, const ComparedNumber& number) {
  const bool is_negative = is_signed && static_cast<std::int64_t>(value) < 0;
  if (is_negative != (number.value < 0)) return is_negative ? -1 : 1;
  const std::uint64_t size = is_negative ? 0 - value : value;
  int order = 0;
  if (!number.size) {
    order = order_of(size, std::abs(number.value));
  } else if (size != *number.size) {
    order = size < *number.size ? -1 : 1;
  }
  return is_negative ? -order : order;
}

Operation opposite(Operation comparison) {
  switch (comparison) {
    case Operation::less:
      return Operation::at_least;
    case Operation::at_most:
      return Operation::more;
    case Operation::more:
      return Operation::at_most;
    case Operation::at_least:
      return Operation::less;
    case Operation::equal:
      return Operation::not_equal;
    default:
      return Operation::equal;
  }
}

// As it is seen from the other side.
Operation mirrored(Operation comparison) {
  switch (comparison) {
    case Operation::less:
      return Operation::more;
    case Operation::at_most:
      return Operation::at_least;
    case Operation::more:
      return Operation::less;
    case Operation::at_least:
      return Operation::at_most;
    default:
      return comparison;
  }
}

const char* sign_of(Operation operation) {
  switch (operation) {
    case Operation::add:
      return "+";
    case Operation::subtract:
      return "-";
    case Operation::multiply:
      return "*";
    case Operation::divide:
      return "/";
    case Operation::power:
      return "^";
    case Operation::less:
      return "<";
    case Operation::at_most:
      return "<=";
    case Operation::more:
      return ">";
    case Operation::at_least:
      return ">=";
    case Operation::equal:
      return "==";
    case Operation::both:
      return "&&";
    default:
      return "||";
  }
}

// The formula as muParser reads it: all in parentheses, fields and functions by numbers, so that
// nothing a user types gets there as it is.
class ProgramWriter {
 public:
  ProgramWriter(const Formula& formula, const FormulaSources& sources)
      : formula_(formula), sources_(sources) {}

  std::string write() { return write(formula_.whole(), false); }
  std::vector<FieldValues> inputs() { return std::move(inputs_); }

 private:
  const FormulaPart& operand(const FormulaPart& part, std::size_t i) const {
    return formula_.parts()[part.operands[i]];
  }

  std::string write(const FormulaPart& part, bool is_negated) {
    switch (part.operation) {
      case Operation::number:
        return fmt::format("({})", part.number);
      case Operation::field:
        return input(formula_.fields()[part.name]);
      case Operation::negate:
        return fmt::format("(-{})", write(operand(part, 0), false));
      case Operation::function:
        return call(part);
      case Operation::choose:
        return fmt::format("({}?{}:{})", write(operand(part, 0), false),
                           write(operand(part, 1), false), write(operand(part, 2), false));
      case Operation::negation:
        return write(operand(part, 0), !is_negated);
      case Operation::both:
      case Operation::either:
        return joined(part, is_negated);
      default:
        return is_comparison(part.operation) ? comparison(part, is_negated)
                                             : binary(part.operation, part, false);
    }
  }

  std::string binary(Operation operation, const FormulaPart& part, bool is_negated) {
    const std::string left = write(operand(part, 0), is_negated);
    return fmt::format("({}{}{})", left, sign_of(operation), write(operand(part, 1), is_negated));
  }

  // Neither of two is the one not and the other not.
  std::string joined(const FormulaPart& part, bool is_negated) {
    const bool is_both = (part.operation == Operation::both) != is_negated;
    return binary(is_both ? Operation::both : Operation::either, part, is_negated);
  }

  std::string comparison(const FormulaPart& part, bool is_negated) {
    const Operation meant = is_negated ? opposite(part.operation) : part.operation;
    const FormulaPart &left = operand(part, 0), &right = operand(part, 1);
    if (const auto exact = whole_comparison(meant, left, right)) return *exact;
    if (const auto exact = whole_comparison(mirrored(meant), right, left)) return *exact;
    if (meant != Operation::not_equal) return binary(meant, part, false);
    return fmt::format("differ({},{})", write(left, false), write(right, false));
  }

  // Of whole numbers with a number: double precision does not tell large ones apart.
  std::optional<std::string> whole_comparison(Operation comparison, const FormulaPart& field,
                                              const FormulaPart& number) {
    const bool is_negative =
        number.operation == Operation::negate && operand(number, 0).operation == Operation::number;
    const bool is_number = number.operation == Operation::number || is_negative;
    if (field.operation != Operation::field || !is_number) return std::nullopt;
    const FormulaPart& size = is_negative ? operand(number, 0) : number;
    const ComparedNumber compared = {is_negative ? -size.number : size.number, size.whole};
    constexpr double first_that_floats_confuse = 16777216;
    const std::optional<WholeNumbers> whole =
        whole_of(formula_.fields()[field.name], std::abs(size.number) >= first_that_floats_confuse);
    if (!whole) return std::nullopt;
    inputs_.emplace_back([=, found = *whole](std::size_t begin, std::size_t end, double* out) {
      for (std::size_t i = begin; i < end; ++i)
        *out++ = compare(comparison, order_of((*found.values)[i], found.are_signed, compared), 0);
    });
    return fmt::format("(f{}!=0)", inputs_.size() - 1);
  }

  std::optional<WholeNumbers> whole_of(const std::string& field, bool are_large) {
    const auto [found, is_new] = whole_.try_emplace({field, are_large});
    if (is_new) found->second = sources_.whole_numbers(field, are_large);
    return found->second;
  }

  std::string input(const std::string& field) {
    const auto [found, is_new] = input_of_.try_emplace(field, inputs_.size());
    if (is_new) {
      const std::optional<WholeNumbers> whole = whole_of(field, false);
      inputs_.push_back(whole ? rounded(field, *whole) : sources_.values(field));
    }
    return fmt::format("f{}", found->second);
  }

  static double as_number(std::uint64_t value, bool is_signed) {
    return is_signed ? static_cast<double>(static_cast<std::int64_t>(value))
                     : static_cast<double>(value);
  }

  static FieldValues rounded(const std::string& field, const WholeNumbers& whole) {
    constexpr double exact = 9007199254740992.0;
    for (const std::uint64_t value : *whole.values) {
      if (std::abs(as_number(value, whole.are_signed)) <= exact) continue;
      throw DataError(fmt::format(
          "the formula: found {} in {}, expected at most 2^53, above which whole numbers are not "
          "exact; compare {} with a number alone, which is exact",
          value, field, field));
    }
    return [whole](std::size_t begin, std::size_t end, double* out) {
      for (std::size_t i = begin; i < end; ++i)
        *out++ = as_number((*whole.values)[i], whole.are_signed);
    };
  }

  std::string call(const FormulaPart& part) {
    std::string text = fmt::format("g{}({}", part.name, write(operand(part, 0), false));
    if (part.operands.size() > 1) text += "," + write(operand(part, 1), false);
    return text + ")";
  }

  const Formula& formula_;
  const FormulaSources& sources_;
  std::vector<FieldValues> inputs_;
  std::map<std::string, std::size_t> input_of_;
  std::map<std::pair<std::string, bool>, std::optional<WholeNumbers>> whole_;
};

}  // namespace

// A parser belongs to one thread at a time. Its own evaluation in bulk starts threads of OpenMP for
// every call, which takes thirty times as long as the values; so it is asked value by value.
class FormulaValues::Machine {
 public:
  Machine(const std::string& program, std::size_t inputs) : values_(inputs), now_(inputs) {
    parser_.ClearFun();
    parser_.ClearConst();
    parser_.DefineFun("differ", differ);
    const std::vector<FormulaFunction>& functions = formula_functions();
    for (std::size_t i = 0; i < functions.size(); ++i) {
      const std::string name = fmt::format("g{}", i);
      if (functions[i].of_one != nullptr) {
        parser_.DefineFun(name, functions[i].of_one);
      } else {
        parser_.DefineFun(name, functions[i].of_two);
      }
    }
    for (std::size_t i = 0; i < inputs; ++i) {
      values_[i].resize(block);
      parser_.DefineVar(fmt::format("f{}", i), &now_[i]);
    }
    parser_.SetExpr(program);
  }

  void evaluate(const std::vector<FieldValues>& inputs, std::size_t begin, std::size_t end,
                double* out) {
    for (std::size_t i = 0; i < inputs.size(); ++i)
      inputs[i](begin, end, values_[i].data());
    for (std::size_t k = 0; k < end - begin; ++k) {
      for (std::size_t i = 0; i < now_.size(); ++i)
        now_[i] = values_[i][k];
      out[k] = parser_.Eval();
    }
  }

 private:
  mu::Parser parser_;
  std::vector<std::vector<double>> values_;
  std::vector<double> now_;
};

FormulaValues::FormulaValues(const Formula& formula, const FormulaSources& sources) {
  ProgramWriter writer(formula, sources);
  program_ = writer.write();
  inputs_ = writer.inputs();
}

FormulaValues::~FormulaValues() = default;

std::unique_ptr<FormulaValues::Machine> FormulaValues::take_machine() const {
  const std::lock_guard<std::mutex> lock(of_machines_);
  if (idle_.empty()) return std::make_unique<Machine>(program_, inputs_.size());
  std::unique_ptr<Machine> machine = std::move(idle_.back());
  idle_.pop_back();
  return machine;
}

void FormulaValues::evaluate(std::size_t begin, std::size_t end, double* values) const {
  try {
    std::unique_ptr<Machine> machine = take_machine();
    for (; begin < end; begin += block, values += block)
      machine->evaluate(inputs_, begin, std::min(begin + block, end), values);
    const std::lock_guard<std::mutex> lock(of_machines_);
    idle_.push_back(std::move(machine));
  } catch (const mu::ParserError& error) {
    throw UsageError(fmt::format("the formula: {}", error.GetMsg()));
  }
}

}  // namespace splotchcl
