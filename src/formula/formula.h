#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

enum class Operation {
  number,
  field,
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  function,
  choose,  // condition ? one : other
  less,
  at_most,
  more,
  at_least,
  equal,
  not_equal,
  negation,  // of what holds or not
  both,
  either,
};

// Whether it holds or not, instead of being a number.
bool is_truth(Operation operation);
bool is_comparison(Operation operation);

// A part of a formula.
struct FormulaPart {
  Operation operation = Operation::number;
  double number = 0;
  std::optional<std::uint64_t> whole;  // the same, exact, of a whole number >= 0
  std::string unit;                    // that is written behind the number, as in 1.5 keV
  std::size_t name = 0;                // of a field among the formula's, of a function among all
  std::vector<std::size_t> operands;   // earlier parts
  std::size_t begin = 0, end = 0;      // in the text
};

// A formula on the fields of a particle, such as "log10(density * temperature)", or a condition on
// them, such as "temperature > 1e6 && ParticleIDs < 500000" (docs/scene.md, Formulas). It knows
// nothing of the fields but their names.
class Formula {
 public:
  // `what` begins the message of the UsageError for a text that is none, or that is too long or
  // too deep.
  static Formula parse(const std::string& text, const std::string& what);
  // Whether a text that no field is called like can be meant as a formula.
  static bool may_be(const std::string& text);

  const std::string& text() const { return text_; }
  // Each after its operands: the last is the whole.
  const std::vector<FormulaPart>& parts() const { return parts_; }
  const FormulaPart& whole() const { return parts_.back(); }
  const std::vector<std::string>& fields() const { return fields_; }
  bool is_condition() const { return is_truth(whole().operation); }
  std::string text_of(const FormulaPart& part) const;
  // With another number in place of one that has a unit.
  void replace_number(std::size_t part, double number);

 private:
  Formula() = default;

  std::string text_;
  std::vector<FormulaPart> parts_;
  std::vector<std::string> fields_;
};

}  // namespace splotchcl
