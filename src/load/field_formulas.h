#pragma once

#include <memory>
#include <optional>
#include <string>

#include "formula/formula.h"
#include "formula/formula_units.h"
#include "formula/formula_values.h"
#include "load/type_fields.h"

// Formulas and conditions on the fields of a type; `key` is the scene's that has them.
namespace splotchcl {

// Throws UsageError for a text that is no condition.
Formula condition_on(const TypeFields& fields, const std::string& text, const std::string& key);

// Refuses, before anything is read, fields that the type does not have and units that do not fit
// each other.
void check_formula(const TypeFields& fields, const Formula& formula, const std::string& key);

std::shared_ptr<const FormulaValues> formula_values(const TypeFields& fields,
                                                    const Formula& formula, const std::string& key);

}  // namespace splotchcl
