#include "formula/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "common/words.h"
#include "formula/formula_words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct ParsedFormula {
  std::vector<FormulaPart> parts;
  std::vector<std::string> fields;
};

constexpr std::size_t longest_text = 1000, most_parts = 400, most_fields = 32;
constexpr int deepest = 50;
constexpr double pi = 3.14159265358979323846;

using Word = FormulaWord;
using Sign = std::pair<const char*, Operation>;

// Each rule reads what binds more closely by the next one.
class FormulaParser {
 public:
  FormulaParser(const std::string& text, const std::string& what)
      : text_(text), what_(what), words_(words_of_formula(text, what)) {}

  ParsedFormula parse() {
    const std::size_t whole = choice();
    if (has_unit(whole)) refuse_unit(whole);
    if (word().kind != Word::Kind::end) refuse("an operator such as + or &&");
    return std::move(parsed_);
  }

 private:
  // Parts lie within parts: the caller's depth is given back at its end.
  class Level {
   public:
    explicit Level(FormulaParser& parser) : depth_(parser.depth_) {
      if (++depth_ > deepest) {
        parser.refuse_size(fmt::format("parts more than {} deep in each other", deepest));
      }
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --depth_; }

   private:
    int& depth_;
  };

  const Word& word() const { return words_[next_]; }
  bool take(const char* sign) {
    if (!word().is_sign(sign)) return false;
    ++next_;
    return true;
  }
  std::optional<Operation> take_one(std::initializer_list<Sign> signs) {
    for (const auto& [sign, operation] : signs) {
      if (take(sign)) return operation;
    }
    return std::nullopt;
  }

  std::size_t choice() {
    const Level level(*this);
    const std::size_t condition = either();
    if (!take("?")) return condition;
    require_truth(condition, "?");
    const std::size_t one = choice();
    if (!take(":")) refuse("a : and what counts otherwise");
    const std::size_t other = choice();
    require_number(one, "?");
    require_number(other, ":");
    return add(Operation::choose, {condition, one, other});
  }

  std::size_t either() {
    std::size_t left = both();
    while (take("||"))
      left = joined(Operation::either, left, both(), "||");
    return left;
  }

  std::size_t both() {
    std::size_t left = negation();
    while (take("&&"))
      left = joined(Operation::both, left, negation(), "&&");
    return left;
  }

  std::size_t joined(Operation operation, std::size_t left, std::size_t right, const char* sign) {
    require_truth(left, sign);
    require_truth(right, sign);
    return add(operation, {left, right});
  }

  std::size_t negation() {
    const std::size_t begin = word().begin;
    if (!take("!")) return comparison();
    const Level level(*this);
    const std::size_t operand = negation();
    require_truth(operand, "!");
    return add(Operation::negation, {operand}, begin);
  }

  std::optional<Operation> take_comparison() {
    return take_one({{"<=", Operation::at_most},
                     {">=", Operation::at_least},
                     {"==", Operation::equal},
                     {"!=", Operation::not_equal},
                     {"<", Operation::less},
                     {">", Operation::more}});
  }

  std::size_t comparison() {
    const std::size_t left = sum();
    const std::optional<Operation> operation = take_comparison();
    if (!operation) return left;
    const std::size_t right = sum();
    const std::string sign = "a comparison";
    require_number(left, sign);
    require_number(right, sign);
    const std::size_t whole = add(*operation, {left, right});
    const std::size_t here = next_;
    if (take_comparison()) {
      next_ = here;
      refuse("one comparison; join two by &&, as in 1 < x && x < 2");
    }
    return whole;
  }

  std::size_t sum() {
    std::size_t left = product();
    while (const auto operation = take_one({{"+", Operation::add}, {"-", Operation::subtract}}))
      left = add_operator(*operation, left, product());
    return left;
  }

  std::size_t product() {
    std::size_t left = signed_power();
    while (const auto operation = take_one({{"*", Operation::multiply}, {"/", Operation::divide}}))
      left = add_operator(*operation, left, signed_power());
    return left;
  }

  std::size_t add_operator(Operation operation, std::size_t left, std::size_t right) {
    return add(operation, {left, right});
  }

  std::size_t signed_power() {
    const std::size_t begin = word().begin;
    if (take("+")) return deeper([this] { return signed_power(); });
    if (!take("-")) return power();
    const std::size_t operand = deeper([this] { return signed_power(); });
    if (has_unit(operand)) return negated(operand, begin);
    return add(Operation::negate, {operand}, begin);
  }

  template <class Read>
  std::size_t deeper(Read&& read) {
    const Level level(*this);
    return read();
  }

  std::size_t power() {
    const std::size_t base = value();
    if (!take("^")) return base;
    const std::size_t exponent = deeper([this] { return signed_power(); });
    return add(Operation::power, {base, exponent});
  }

  std::size_t value() {
    const Word& found = word();
    switch (found.kind) {
      case Word::Kind::number:
        return number();
      case Word::Kind::quoted_name:
        return field();
      case Word::Kind::name:
        if (words_[next_ + 1].is_sign("(")) return call();
        return found.text == "pi" ? constant(pi) : field();
      case Word::Kind::sign:
      case Word::Kind::end:
        break;
    }
    if (!take("(")) refuse("a number, a field, a function or (");
    const std::size_t inner = choice();
    if (!take(")")) refuse("an operator or )");
    return inner;
  }

  std::size_t number() {
    const std::string& text = word().text;
    const std::optional<double> value = parse_number(text);
    if (!value || !std::isfinite(*value)) refuse("a number such as 1.5e6");
    const std::size_t part = constant(*value);
    parsed_.parts[part].whole = whole_of(text, *value);
    if (word().kind == Word::Kind::name && !words_[next_ + 1].is_sign("(")) read_unit(part);
    return part;
  }

  // 1e-26 g/cm^3: all as far as no sign of a unit's.
  void read_unit(std::size_t part) {
    const std::size_t begin = word().begin;
    const auto goes_on = [this] {
      const bool is_exponent = words_[next_ - 1].is_sign("^") && word().is_sign("-");
      return is_exponent || word().is_sign("*") || word().is_sign("/") || word().is_sign("^") ||
             word().kind == Word::Kind::name || word().kind == Word::Kind::number;
    };
    while (goes_on())
      ++next_;
    FormulaPart& number = parsed_.parts[part];
    number.end = words_[next_ - 1].end;
    number.unit = text_.substr(begin, number.end - begin);
  }

  bool has_unit(std::size_t part) const { return !parsed_.parts[part].unit.empty(); }

  std::size_t negated(std::size_t part, std::size_t begin) {
    FormulaPart& number = parsed_.parts[part];
    number.number = -number.number;
    number.whole.reset();
    number.begin = begin;
    return part;
  }

  [[noreturn]] void refuse_unit(std::size_t part) const {
    throw UsageError(
        fmt::format("{}: found {} in \"{}\", expected a number with a unit only as one side of a "
                    "comparison, such as temperature > 1e6 K; a sum or a product takes numbers "
                    "alone, in the fields' own units",
                    what_, quoted(part), text_));
  }

  // Exact however it is written: 1099511627776, 1.2e18, 5.0.
  static std::optional<std::uint64_t> whole_of(const std::string& text, double value) {
    if (value != std::floor(value)) return std::nullopt;
    const std::size_t mantissa_end = std::min(text.find_first_of("eE"), text.size());
    std::string digits = text.substr(0, mantissa_end);
    int power = 0;
    if (mantissa_end < text.size()) {
      const std::size_t begin = mantissa_end + (text[mantissa_end + 1] == '+' ? 2 : 1);
      const char* const end = text.data() + text.size();
      const auto [rest, error] = std::from_chars(text.data() + begin, end, power);
      constexpr int beyond_any_text = 10000;
      if (error != std::errc() || rest != end || std::abs(power) > beyond_any_text)
        return std::nullopt;
    }
    if (const std::size_t point = digits.find('.'); point != std::string::npos) {
      power -= static_cast<int>(digits.size() - point) - 1;
      digits.erase(point, 1);
    }
    constexpr int most_digits = 20;  // of 2^64
    if (power > most_digits) return std::nullopt;
    digits.append(static_cast<std::size_t>(std::max(power, 0)), '0');
    for (; power < 0 && digits.size() > 1 && digits.back() == '0'; ++power)
      digits.pop_back();
    std::uint64_t whole = 0;
    const char* const end = digits.data() + digits.size();
    const auto [rest, error] = std::from_chars(digits.data(), end, whole);
    const bool is_whole = error == std::errc() && rest == end && power >= 0;
    return is_whole ? std::optional(whole) : std::nullopt;
  }

  std::size_t constant(double value) {
    const std::size_t begin = word().begin;
    ++next_;
    const std::size_t part = add(Operation::number, {}, begin);
    parsed_.parts[part].number = value;
    return part;
  }

  std::size_t field() {
    const Word& found = word();
    std::vector<std::string>& names = parsed_.fields;
    const auto known = std::find(names.begin(), names.end(), found.text);
    const auto name = static_cast<std::size_t>(known - names.begin());
    if (known == names.end()) {
      if (names.size() == most_fields) refuse_size(fmt::format("more than {} fields", most_fields));
      names.push_back(found.text);
    }
    ++next_;
    const std::size_t part = add(Operation::field, {}, found.begin);
    parsed_.parts[part].name = name;
    return part;
  }

  std::size_t call() {
    const Word& name = word();
    if (name.text == "pow") return arguments_of(name, 2, Operation::power, 0);
    const std::optional<std::size_t> function = find_formula_function(name.text);
    if (!function) refuse_function(name);
    return arguments_of(name, formula_functions()[*function].arguments(), Operation::function,
                        *function);
  }

  std::size_t arguments_of(const Word& name, std::size_t count, Operation operation,
                           std::size_t function) {
    next_ += 2;
    std::vector<std::size_t> operands;
    do
      operands.push_back(choice());
    while (take(","));
    if (!take(")")) refuse("an operator, a comma or )");
    if (operands.size() != count) {
      throw UsageError(fmt::format("{}: found {} with {} in \"{}\", expected {}", what_, name.text,
                                   counted(operands.size(), "argument"), text_, count));
    }
    const std::size_t part = add(operation, operands, name.begin);
    parsed_.parts[part].name = function;
    return part;
  }

  std::size_t add(Operation operation, std::vector<std::size_t> operands) {
    const std::size_t begin = parsed_.parts[operands.front()].begin;
    return add(operation, std::move(operands), begin);
  }

  std::size_t add(Operation operation, std::vector<std::size_t> operands, std::size_t begin) {
    if (parsed_.parts.size() == most_parts) {
      refuse_size(fmt::format("more than {} numbers, fields and operators", most_parts));
    }
    for (const std::size_t operand : operands) {
      if (has_unit(operand) && !is_comparison(operation)) refuse_unit(operand);
    }
    FormulaPart part;
    part.operation = operation;
    part.operands = std::move(operands);
    part.begin = begin;
    part.end = words_[next_ - 1].end;
    parsed_.parts.push_back(std::move(part));
    return parsed_.parts.size() - 1;
  }

  bool is_truth_at(std::size_t part) const { return is_truth(parsed_.parts[part].operation); }

  std::string quoted(std::size_t part) const {
    const FormulaPart& found = parsed_.parts[part];
    return text_.substr(found.begin, found.end - found.begin);
  }

  void require_truth(std::size_t part, const std::string& sign) const {
    if (is_truth_at(part)) return;
    throw UsageError(
        fmt::format("{}: found the number {} beside {} in \"{}\", expected a "
                    "comparison, such as {} > 0",
                    what_, quoted(part), sign, text_, quoted(part)));
  }

  void require_number(std::size_t part, const std::string& sign) const {
    if (!is_truth_at(part)) return;
    throw UsageError(fmt::format("{}: found the comparison {} in {} in \"{}\", expected numbers",
                                 what_, quoted(part), sign, text_));
  }

  [[noreturn]] void refuse_function(const Word& name) const {
    std::vector<std::string> names = names_of_formula_functions();
    names.emplace_back("pow");
    throw UsageError(fmt::format("{}: found the function {} in \"{}\", expected one of {}{}", what_,
                                 name.text, text_, fmt::join(names, ", "),
                                 did_you_mean(nearest_name(name.text, names))));
  }

  [[noreturn]] void refuse(const std::string& expected) const {
    const std::string found =
        word().kind == Word::Kind::end
            ? "the end"
            : fmt::format("{} at character {}",
                          text_.substr(word().begin, word().end - word().begin), word().begin + 1);
    throw UsageError(
        fmt::format("{}: found {} of \"{}\", expected {}", what_, found, text_, expected));
  }

  [[noreturn]] void refuse_size(const std::string& found) const {
    throw UsageError(
        fmt::format("{}: found {}, expected a shorter formula; make a field of it in the snapshot",
                    what_, found));
  }

  const std::string& text_;
  const std::string& what_;
  std::vector<Word> words_;
  std::size_t next_ = 0;
  int depth_ = 0;
  ParsedFormula parsed_;
};

// What Formula::parse() does.
ParsedFormula parse_formula(const std::string& text, const std::string& what) {
  if (text.size() > longest_text) {
    throw UsageError(fmt::format(
        "{}: found a formula of {} characters, expected at most {}; make a field of it in the "
        "snapshot",
        what, text.size(), longest_text));
  }
  return FormulaParser(text, what).parse();
}

}  // namespace

bool is_comparison(Operation operation) {
  return operation >= Operation::less && operation <= Operation::not_equal;
}

bool is_truth(Operation operation) {
  return operation >= Operation::less;
}

Formula Formula::parse(const std::string& text, const std::string& what) {
  ParsedFormula parsed = parse_formula(text, what);
  Formula formula;
  formula.text_ = text;
  formula.parts_ = std::move(parsed.parts);
  formula.fields_ = std::move(parsed.fields);
  return formula;
}

bool Formula::may_be(const std::string& text) {
  return text.find_first_of("+-*/^()<>=!&|?`") != std::string::npos ||
         text.find(" and ") != std::string::npos || text.find(" or ") != std::string::npos;
}

void Formula::replace_number(std::size_t part, double number) {
  parts_[part].number = number;
  parts_[part].whole.reset();
  parts_[part].unit.clear();
}

std::string Formula::text_of(const FormulaPart& part) const {
  return trimmed(text_.substr(part.begin, part.end - part.begin));
}

}  // namespace splotchcl
