#include "formula/formula.h"

#include <utility>

#include "common/words.h"
#include "formula/formula_parser.h"

namespace splotchcl {

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
