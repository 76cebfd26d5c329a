#include "formula/formula_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Kind = FormulaWord::Kind;

// Longer ones first: "<=" begins with "<". What other languages write stands for ours.
constexpr std::array<std::pair<const char*, const char*>, 22> signs = {{
    {"&&", "&&"}, {"||", "||"}, {"<=", "<="}, {">=", ">="}, {"==", "=="}, {"!=", "!="},
    {"**", "^"},  {"<", "<"},   {">", ">"},   {"!", "!"},   {"+", "+"},   {"-", "-"},
    {"*", "*"},   {"/", "/"},   {"^", "^"},   {"(", "("},   {")", ")"},   {",", ","},
    {"?", "?"},   {":", ":"},   {"=", "="},   {"&", "&"},
}};

constexpr std::array<std::pair<const char*, const char*>, 3> signs_in_words = {
    {{"and", "&&"}, {"or", "||"}, {"not", "!"}}};

// Bytes of UTF-8 beyond ASCII, too.
bool begins_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool continues_name(char c) {
  return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
}

bool begins_number(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
}

class WordReader {
 public:
  WordReader(const std::string& text, const std::string& what) : text_(text), what_(what) {}

  std::vector<FormulaWord> all() {
    std::vector<FormulaWord> words;
    do
      words.push_back(next());
    while (words.back().kind != Kind::end);
    return words;
  }

 private:
  FormulaWord next() {
    while (next_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[next_])) != 0)
      ++next_;
    if (next_ == text_.size()) return word(Kind::end, next_);
    const char c = text_[next_];
    if (c == '`') return quoted_name();
    if (begins_number(c)) return word(Kind::number, end_of_number(text_, next_));
    if (begins_name(c)) return name();
    return sign();
  }

  FormulaWord word(Kind kind, std::size_t end) {
    FormulaWord word{kind, text_.substr(next_, end - next_), next_, end};
    next_ = end;
    return word;
  }

  FormulaWord name() {
    const auto end = std::find_if_not(text_.begin() + static_cast<std::ptrdiff_t>(next_),
                                      text_.end(), continues_name);
    FormulaWord found = word(Kind::name, static_cast<std::size_t>(end - text_.begin()));
    for (const auto& [spelled, meant] : signs_in_words) {
      if (found.text != spelled) continue;
      found.kind = Kind::sign;
      found.text = meant;
    }
    return found;
  }

  FormulaWord quoted_name() {
    const std::size_t end = text_.find('`', next_ + 1);
    if (end == std::string::npos || end == next_ + 1) {
      refuse("a ` that begins no name", "`name of a field`, with a ` before and behind it");
    }
    FormulaWord found = word(Kind::quoted_name, end + 1);
    found.text = found.text.substr(1, found.text.size() - 2);
    return found;
  }

  FormulaWord sign() {
    for (const auto& [spelled, meant] : signs) {
      const std::string sign = spelled;
      if (text_.compare(next_, sign.size(), sign) != 0) continue;
      if (sign == "=") refuse("=", "== to compare");
      if (sign == "&") refuse("&", "&& or and");
      FormulaWord found = word(Kind::sign, next_ + sign.size());
      found.text = meant;
      return found;
    }
    if (text_[next_] == '|') refuse("|", "|| or or");
    refuse(fmt::format("'{}'", text_[next_]),
           "numbers, fields, functions, + - * / ^ and comparisons; a field of such a name in `");
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw UsageError(fmt::format("{}: found {} at character {} of \"{}\", expected {}", what_,
                                 found, next_ + 1, text_, expected));
  }

  const std::string& text_;
  const std::string& what_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<FormulaWord> words_of_formula(const std::string& text, const std::string& what) {
  return WordReader(text, what).all();
}

namespace {

template <double (*function)(double)>
constexpr FormulaFunction of_one(const char* name, FunctionUnit unit = FunctionUnit::none) {
  return {name, function, nullptr, unit};
}

constexpr FormulaFunction of_two(const char* name, double (*function)(double, double),
                                 FunctionUnit unit) {
  return {name, nullptr, function, unit};
}

// What is not a number stays none, which fmin and fmax would hide.
double lesser(double a, double b) {
  return std::isnan(a) || a < b ? a : b;
}

double greater(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

}  // namespace

const std::vector<FormulaFunction>& formula_functions() {
  using Unit = FunctionUnit;
  static const std::vector<FormulaFunction> functions = {
      of_one<std::sqrt>("sqrt", Unit::square_root),
      of_one<std::cbrt>("cbrt", Unit::cube_root),
      of_one<std::fabs>("abs", Unit::same),
      of_one<std::floor>("floor", Unit::same),
      of_one<std::ceil>("ceil", Unit::same),
      of_one<std::round>("round", Unit::same),
      of_one<std::exp>("exp"),
      of_one<std::log>("log"),
      of_one<std::log>("ln"),
      of_one<std::log10>("log10"),
      of_one<std::log2>("log2"),
      of_one<std::sin>("sin"),
      of_one<std::cos>("cos"),
      of_one<std::tan>("tan"),
      of_one<std::asin>("asin"),
      of_one<std::acos>("acos"),
      of_one<std::atan>("atan"),
      of_one<std::sinh>("sinh"),
      of_one<std::cosh>("cosh"),
      of_one<std::tanh>("tanh"),
      of_one<std::asinh>("asinh"),
      of_one<std::acosh>("acosh"),
      of_one<std::atanh>("atanh"),
      of_two("atan2", std::atan2, Unit::none),
      of_two("hypot", std::hypot, Unit::same),
      of_two("min", lesser, Unit::same),
      of_two("max", greater, Unit::same),
  };
  return functions;
}

std::optional<std::size_t> find_formula_function(const std::string& name) {
  const auto& all = formula_functions();
  const auto found = std::find_if(all.begin(), all.end(), [&name](const FormulaFunction& function) {
    return name == function.name;
  });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

std::vector<std::string> names_of_formula_functions() {
  std::vector<std::string> names;
  for (const FormulaFunction& function : formula_functions())
    names.emplace_back(function.name);
  return names;
}

}  // namespace splotchcl
