#include "load/field_formulas.h"

#include <fmt/format.h>

#include <algorithm>

#include "formula/selection.h"
#include "load/derived_fields.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Identifiers are compared with identifiers, and with nothing between them.
void check_ids_compared(const TypeFields& fields, const Formula& formula, const std::string& key) {
  const auto is_id = [&](const FormulaPart& part) {
    return part.operation == Operation::field &&
           canonical_field_name(formula.fields()[part.name]) == "id";
  };
  for (const FormulaPart& part : formula.parts()) {
    if (!is_comparison(part.operation)) continue;
    const FormulaPart &left = formula.parts()[part.operands[0]],
                      &right = formula.parts()[part.operands[1]];
    const FormulaPart& other = is_id(left) ? right : left;
    const bool is_number = other.operation == Operation::number && !other.whole;
    const bool is_negative = other.operation == Operation::negate;
    if (!is_id(left) && !is_id(right)) continue;
    if (!is_number && !is_negative) continue;
    throw UsageError(fmt::format(
        "{} \"{}\": found ids compared with {}, expected a whole number from 0 to 2^64 - 1",
        fields.what(key), formula.text(), formula.text_of(other)));
  }
}

UnitOfField units_of(const TypeFields& fields) {
  return [&fields](const std::string& name) {
    return written_unit(unit_of(fields.info(), name), unit_factors(fields.snapshot_info()));
  };
}

// Its numbers in the units of the fields.
Formula in_units_of(const TypeFields& fields, const Formula& formula, const std::string& key) {
  return with_converted_numbers(formula, units_of(fields), unit_factors(fields.snapshot_info()),
                                fields.what(key));
}

}  // namespace

Formula condition_on(const TypeFields& fields, const std::string& text, const std::string& key) {
  const std::optional<Formula> comparisons = parse_comparisons(text);
  if (!comparisons) return parse_condition(text, fields.what(key));
  const auto& names = comparisons->fields();
  const bool are_fields = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return canonical_field_name(name) == "id" || fields.has_plain(name);
  });
  const bool are_formulas = std::any_of(names.begin(), names.end(), Formula::may_be);
  return are_fields || !are_formulas ? *comparisons : Formula::parse(text, fields.what(key));
}

void check_formula(const TypeFields& fields, const Formula& formula, const std::string& key) {
  for (const std::string& name : formula.fields()) {
    const bool is_id = canonical_field_name(name) == "id";
    if (!is_id && !fields.has_plain(name)) fields.refuse_field(name, key);
  }
  check_ids_compared(fields, formula, key);
  unit_of_formula(in_units_of(fields, formula, key), units_of(fields), fields.what(key));
}

std::shared_ptr<const FormulaValues> formula_values(const TypeFields& fields,
                                                    const Formula& formula,
                                                    const std::string& key) {
  FormulaSources sources;
  sources.values = [&](const std::string& field) { return fields.plain_values(field, key); };
  sources.whole_numbers = [&](const std::string& field) { return fields.whole_numbers(field); };
  return std::make_shared<const FormulaValues>(in_units_of(fields, formula, key), sources);
}

}  // namespace splotchcl
