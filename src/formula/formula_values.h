#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "formula/formula.h"

namespace splotchcl {

// Writes the values of particles [begin, end). May be called from several threads at once.
using FieldValues = std::function<void(std::size_t begin, std::size_t end, double* values)>;

// Whole numbers of 64 bits, one for each particle; below 0 modulo 2^64 where they have a sign.
struct WholeNumbers {
  std::shared_ptr<const std::vector<std::uint64_t>> values;
  bool are_signed = false;
};

// Where a formula's fields come from. Only those that it needs are asked for, each once.
struct FormulaSources {
  std::function<FieldValues(const std::string& field)> values;
  // Nothing: the field has no whole numbers. `are_large`: it is compared with one that floats do
  // not tell from others.
  std::function<std::optional<WholeNumbers>(const std::string& field, bool are_large)>
      whole_numbers;
};

// A formula's values, in double precision. A comparison with what is not a number does not hold,
// nor does its negation.
class FormulaValues {
 public:
  FormulaValues(const Formula& formula, const FormulaSources& sources);
  ~FormulaValues();
  FormulaValues(const FormulaValues&) = delete;
  FormulaValues& operator=(const FormulaValues&) = delete;

  // Of particles [begin, end), on the calling thread; what holds is 1. May be called from several
  // threads at once.
  void evaluate(std::size_t begin, std::size_t end, double* values) const;

 private:
  class Machine;
  std::unique_ptr<Machine> take_machine() const;

  std::string program_;
  std::vector<FieldValues> inputs_;
  mutable std::mutex of_machines_;
  mutable std::vector<std::unique_ptr<Machine>> idle_;
};

}  // namespace splotchcl
