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
  // `limit` may be null. `tolerance` and `bound` are of white.
  void add(const HardCase& hard, LightPlan plan, const std::string& shape, double error,
           double tolerance, double bound, const KnownLimit* limit) {
    std::ostringstream row;
    row << std::left << std::setw(34) << hard.name << std::setw(14) << name(plan) << std::setw(8)
        << shape << std::right << std::scientific << std::setprecision(1) << std::setw(9) << error
        << std::setw(9) << bound << "  " << verdict(error, tolerance, bound, limit);
    rows_.push_back(row.str());
    if (limit == nullptr) return;
    const std::string note = hard.name + ": " + limit->reason;
    if (notes_.empty() || notes_.back() != note) notes_.push_back(note);
  }

  void print(std::ostream& out) const {
    out << "\nlargest |frame - exact| / max(1, |exact|) of each hard case\n"
        << std::left << std::setw(34) << "case" << std::setw(14) << "plan" << std::setw(8) << "way"
        << std::right << std::setw(9) << "error" << std::setw(9) << "bound"
        << "\n";
    for (const std::string& row : rows_)
      out << row << "\n";
    for (const std::string& note : notes_)
      out << "known limit: " << note << "\n";
  }

 private:
  static const char* verdict(double error, double tolerance, double bound,
                             const KnownLimit* limit) {
    if (!(error <= bound)) return "BEYOND";
    if (limit == nullptr) return "holds";
    return error > tolerance ? "known limit" : "holds here, has a known limit";
  }

  std::vector<std::string> rows_, notes_;
};

}  // namespace splotchcl::test
