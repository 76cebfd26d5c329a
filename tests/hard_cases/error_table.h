#pragma once

#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "hard_cases/hard_cases.h"

namespace splotchcl::test {

// The measured errors of all runs, one row each.
class ErrorTable {
 public:
  // `bound` is of white, as the error is.
  void add(const HardCase& hard, LightPlan plan, const std::string& shape, double error,
           double bound) {
    std::ostringstream row;
    row << std::left << std::setw(34) << hard.name << std::setw(14) << name(plan) << std::setw(8)
        << shape << std::right << std::scientific << std::setprecision(1) << std::setw(9) << error
        << std::setw(9) << bound << (error <= bound ? "  holds" : "  BEYOND");
    rows_.push_back(row.str());
    if (!(error <= bound)) ++beyond_;
  }

  void print(std::ostream& out) const {
    out << "\nlargest |frame - exact| / max(1, |exact|) of each hard case\n"
        << std::left << std::setw(34) << "case" << std::setw(14) << "plan" << std::setw(8) << "way"
        << std::right << std::setw(9) << "error" << std::setw(9) << "bound"
        << "\n";
    for (const std::string& row : rows_)
      out << row << "\n";
    out << rows_.size() << " pictures, " << beyond_ << " beyond their bound\n";
  }

 private:
  std::vector<std::string> rows_;
  int beyond_ = 0;
};

}  // namespace splotchcl::test
