#pragma once

#include <string>
#include <vector>

#include "formula/formula.h"

namespace splotchcl {

struct ParsedFormula {
  std::vector<FormulaPart> parts;
  std::vector<std::string> fields;
};

// What Formula::parse() does.
ParsedFormula parse_formula(const std::string& text, const std::string& what);

}  // namespace splotchcl
