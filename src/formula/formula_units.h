#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formula/formula.h"
#include "snapshot/unit.h"

namespace splotchcl {

// A unit that is known, and how it is written: the product of powers of names.
struct WrittenUnit {
  Unit unit;
  std::vector<std::pair<std::string, double>> factors;

  std::string text() const;
};

// Nothing where a field's unit is not known.
using UnitOfField = std::function<std::optional<WrittenUnit>(const std::string& field)>;

// The unit of a formula's values: known where they are a product, quotient or power of known ones.
// Throws UsageError, which `what` begins, where values of units that differ are added or compared.
std::optional<WrittenUnit> unit_of_formula(const Formula& formula, const UnitOfField& unit_of,
                                           const std::string& what);

// The formula with numbers that have a unit in that of what they are compared with; temperatures
// may be compared with energies, as k_B T. Throws UsageError, which `what` begins, for units that
// do not fit, and where the other side's is not known.
Formula with_converted_numbers(Formula formula, const UnitOfField& unit_of,
                               const UnitFactors& factors, const std::string& what);

// A field's, from how a file writes it; nothing where that is no unit that is known.
std::optional<WrittenUnit> written_unit(const std::string& text, UnitFactors factors);

}  // namespace splotchcl
