// Formulas on fields: what they mean, in which unit, and what is none.
#include "formula/formula.h"

#include <thread>

#include "formula/formula_units.h"
#include "formula/formula_values.h"
#include "formula/formula_words.h"
#include "testing.h"
#include "text_rows.h"

namespace splotchcl::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

FieldValues values_of(std::vector<double> values) {
  return [values = std::move(values)](std::size_t begin, std::size_t end, double* out) {
    for (std::size_t i = begin; i < end; ++i)
      *out++ = values[i];
  };
}

FormulaSources sources(const std::map<std::string, std::vector<double>>& fields) {
  FormulaSources sources;
  sources.values = [fields](const std::string& name) { return values_of(fields.at(name)); };
  sources.whole_numbers = [](const std::string&, bool) { return std::nullopt; };
  return sources;
}

std::vector<double> evaluate(const std::string& text, const FormulaSources& sources,
                             std::size_t count) {
  const FormulaValues values(Formula::parse(text, "formula"), sources);
  std::vector<double> out(count);
  values.evaluate(0, count, out.data());
  return out;
}

// With x = 3 and y = 5.
double value_of(const std::string& text) {
  return evaluate(text, sources({{"x", {3}}, {"y", {5}}}), 1).front();
}

std::string refusal_of(const std::string& text) {
  try {
    Formula::parse(text, "here");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no refusal of " + text;
}

TEST(Formula, HasTheFunctionsThatAreListed) {
  EXPECT_DOUBLE_EQ(value_of("log10(x * y)"), std::log10(15));
  EXPECT_DOUBLE_EQ(value_of("log(x)"), std::log(3));
  EXPECT_DOUBLE_EQ(value_of("hypot(x, y)"), std::hypot(3, 5));
  EXPECT_DOUBLE_EQ(value_of("atan2(x, y)"), std::atan2(3, 5));
  EXPECT_DOUBLE_EQ(value_of("pow(x, 2) + min(x, y) + max(x, y)"), 17);
  EXPECT_DOUBLE_EQ(value_of("cos(pi)"), -1);
  for (const FormulaFunction& function : formula_functions()) {
    const std::string arguments = function.arguments() == 1 ? "(1)" : "(1, 2)";
    const double expected = function.of_one != nullptr ? function.of_one(1) : function.of_two(1, 2);
    EXPECT_EQ(value_of(function.name + arguments), expected) << function.name;
  }
}

TEST(Formula, KnowsItsFieldsByWhateverTheyAreCalled) {
  const Formula formula = Formula::parse("`Points:0` + a_1.b * `Points:0` + ρ", "formula");
  EXPECT_THAT(formula.fields(), ElementsAre("Points:0", "a_1.b", "ρ"));
}

TEST(Formula, HoldsForNothingThatIsNoNumber) {
  const FormulaSources values = sources({{"x", {nan, 1}}});
  for (const char* text : {"x > 5", "!(x > 5)", "x == 5", "x != 5", "!(x == 5)", "!(x != 5)",
                           "not (x > 5 or x < 2)", "sqrt(-1 + 0*x) != 3"}) {
    EXPECT_EQ(evaluate(text, values, 2).front(), 0) << text;
  }
  EXPECT_TRUE(std::isnan(evaluate("2 * x", values, 2).front()));
  EXPECT_TRUE(std::isnan(evaluate("max(1, x)", values, 2).front()));
  EXPECT_TRUE(std::isnan(evaluate("min(x, 1)", values, 2).front()));
}

TEST(Formula, ComparesWholeNumbersOf64BitsExactly) {
  const auto ids = std::make_shared<const std::vector<std::uint64_t>>(
      std::vector<std::uint64_t>{9007199254740993, 9007199254740992, 18446744073709551615U});
  FormulaSources unsigned_ids = sources({}), signed_ids = sources({});
  unsigned_ids.whole_numbers = [ids](const std::string&, bool) { return WholeNumbers{ids, false}; };
  signed_ids.whole_numbers = [ids](const std::string&, bool) { return WholeNumbers{ids, true}; };
  EXPECT_THAT(evaluate("id == 9007199254740993", unsigned_ids, 3), ElementsAre(1, 0, 0));
  EXPECT_THAT(evaluate("9007199254740992 < id", unsigned_ids, 3), ElementsAre(1, 0, 1));
  EXPECT_THAT(evaluate("!(id < 18446744073709551615)", unsigned_ids, 3), ElementsAre(0, 0, 1));
  EXPECT_THAT(evaluate("id >= 0", signed_ids, 3), ElementsAre(1, 1, 0));
  EXPECT_THAT(evaluate("id == -1", signed_ids, 3), ElementsAre(0, 0, 1));
  EXPECT_THROW(evaluate("id / 2", unsigned_ids, 3), DataError);
}

TEST(Formula, ComparesWholeNumbersExactlyHoweverTheyAreWritten) {
  const auto whole = [](std::vector<std::uint64_t> numbers, bool are_signed) {
    FormulaSources values = sources({});
    const auto shared = std::make_shared<const std::vector<std::uint64_t>>(std::move(numbers));
    values.whole_numbers = [=](const std::string&, bool) {
      return WholeNumbers{shared, are_signed};
    };
    return values;
  };
  constexpr std::uint64_t large = 1000000000000000000;
  const FormulaSources some = whole({large - 1, large, large + 1}, false);
  for (const std::string number : {"1e18", "1E+18", "1.000e18", "10e17", "1000000000000000000.0"})
    EXPECT_THAT(evaluate("x == " + number, some, 3), ElementsAre(0, 1, 0)) << number;
  EXPECT_THAT(evaluate("x < 1.000000000000000001e18", some, 3), ElementsAre(1, 1, 0));
  EXPECT_THAT(evaluate("x < 1e300", some, 3), ElementsAre(1, 1, 1));
  EXPECT_THAT(evaluate("x > 999999999999999872.5", some, 3), ElementsAre(1, 1, 1));
  const FormulaSources below = whole({0 - large - 1, 0 - large, 1 - large, 1}, true);
  EXPECT_THAT(evaluate("x == -1000000000000000001", below, 4), ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(evaluate("x > -1e18", below, 4), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(evaluate("x <= -1e18", below, 4), ElementsAre(1, 1, 0, 0));
  EXPECT_THAT(evaluate("x > 0.5", below, 4), ElementsAre(0, 0, 0, 1));
  EXPECT_THAT(evaluate("x > -1e300", below, 4), ElementsAre(1, 1, 1, 1));
}

TEST(Formula, AsksForWholeNumbersOfAnyFieldThatIsComparedWithOneBeyondFloats) {
  const auto numbers = std::make_shared<const std::vector<std::uint64_t>>(
      std::vector<std::uint64_t>{16777216, 16777217, 18446744073709551615U});
  FormulaSources values = sources({{"x", {16777216, 16777216, 1.8e19}}});
  values.whole_numbers = [numbers](const std::string&, bool are_large) {
    return are_large ? std::optional(WholeNumbers{numbers, false}) : std::nullopt;
  };
  EXPECT_THAT(evaluate("x == 16777217", values, 3), ElementsAre(0, 1, 0));
  EXPECT_THAT(evaluate("x == 16777216", values, 3), ElementsAre(1, 0, 0));
  EXPECT_THAT(evaluate("x == 18446744073709551615", values, 3), ElementsAre(0, 0, 1));
  EXPECT_THAT(evaluate("x > 16777217", values, 3), ElementsAre(0, 0, 1));
}

TEST(Formula, AsksForAFieldOnceAndForNoOther) {
  std::vector<std::string> asked;
  FormulaSources values = sources({{"x", {1}}, {"y", {2}}});
  values.values = [&asked](const std::string& name) {
    asked.push_back(name);
    return values_of({1});
  };
  evaluate("x + x * x > y && y < 3", values, 1);
  EXPECT_THAT(asked, ElementsAre("x", "y"));
}

TEST(Formula, HasTheSameValuesOnSeveralThreadsAndInParts) {
  constexpr std::size_t count = 5000;
  std::vector<double> x(count);
  for (std::size_t i = 0; i < count; ++i)
    x[i] = static_cast<double>(i);
  const FormulaValues values(Formula::parse("x * x + 1", "formula"), sources({{"x", x}}));
  std::vector<double> out(count);
  std::vector<std::thread> threads;
  for (std::size_t part = 0; part < 5; ++part) {
    threads.emplace_back(
        [&, part] { values.evaluate(part * 1000, (part + 1) * 1000, out.data() + part * 1000); });
  }
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < count; ++i)
    ASSERT_EQ(out[i], x[i] * x[i] + 1);
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i)
    all += text;
  return all;
}

TEST(Formula, IsBoundedInLengthDepthTermsAndFields) {
  EXPECT_THAT(refusal_of(repeated("1+", 600) + "1"), HasSubstr("1201 characters"));
  EXPECT_THAT(refusal_of(repeated("(", 60) + "x" + repeated(")", 60)), HasSubstr("50 deep"));
  EXPECT_THAT(refusal_of(repeated("-", 60) + "x"), HasSubstr("50 deep"));
  EXPECT_THAT(refusal_of(repeated("!", 60) + "x"), HasSubstr("50 deep"));
  EXPECT_THAT(refusal_of(repeated("2^", 60) + "x"), HasSubstr("50 deep"));
  EXPECT_THAT(refusal_of(repeated("1+", 300) + "1"), HasSubstr("more than 400"));
  std::string sum = "0";
  for (int i = 0; i < 40; ++i)
    sum += "+x" + std::to_string(i);
  EXPECT_THAT(refusal_of(sum), HasSubstr("more than 32 fields"));
}

TEST(Formula, StaysWithinTheEvaluatorsLimitsAtItsOwn) {
  EXPECT_EQ(value_of(repeated("1+", 199) + "1"), 200);
  EXPECT_EQ(value_of(repeated("(", 49) + "x" + repeated(")", 49)), 3);
  EXPECT_TRUE(std::isnan(value_of(repeated("1e300*", 150) + "0")));
}

// T in K, rho in g/cm^3, r in kpc, R in Mpc, n unknown.
std::optional<WrittenUnit> unit_of_field(const std::string& name) {
  const std::map<std::string, std::string> units = {
      {"T", "K"}, {"rho", "g/cm^3"}, {"r", "kpc"}, {"R", "Mpc"}, {"v", "km/s"}};
  const auto found = units.find(name);
  return found == units.end() ? std::nullopt : written_unit(found->second, {});
}

std::string unit(const std::string& text) {
  const auto found = unit_of_formula(Formula::parse(text, "here"), unit_of_field, "here");
  return found ? found->text() : "none";
}

// The number that a comparison has, in the unit of the field.
double number_in(const std::string& text) {
  const Formula formula =
      with_converted_numbers(Formula::parse(text, "here"), unit_of_field, {0.5, 0.7}, "here");
  for (const FormulaPart& part : formula.parts()) {
    if (part.operation == Operation::number) return part.number;
  }
  return 0;
}

class FormulaText : public ::testing::TestWithParam<TextRow> {};

TEST_P(FormulaText, IsWorkedOutOrRefusedInOneLine) {
  for (std::string text : GetParam().texts) {
    text.pop_back();  // the end of its line
    SCOPED_TRACE(text);
    for (const std::string& part : GetParam().expected) {
      const std::size_t blank = part.find(' ');
      const std::string what = part.substr(0, blank), value = part.substr(blank + 1);
      if (what == "is") {
        EXPECT_EQ(value_of(text), std::stod(value));
      } else if (what == "unit") {
        EXPECT_EQ(unit(text), value);
      } else if (what == "number") {
        EXPECT_NEAR(number_in(text) / std::stod(value), 1, 5e-13);
      } else if (value.rfind("units ", 0) == 0) {
        const std::string refused = refusal_by<UsageError>([&] { number_in(text), unit(text); });
        EXPECT_THAT(refused, HasSubstr(value.substr(6)));
      } else {
        ASSERT_EQ(what, "refused");
        EXPECT_THAT(refusal_of(text),
                    AllOf(HasSubstr("here: found"), HasSubstr(value), Not(HasSubstr("\n"))));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, FormulaText,
                         ::testing::ValuesIn(read_text_rows(source_folder() /
                                                            "tests/formula/formulas.rows")),
                         [](const auto& info) { return info.param.name; });

TEST(Formula, OfNothingIsRefused) {
  EXPECT_THAT(refusal_of(""), HasSubstr("here: found the end"));
}

TEST(NumbersWithUnits, OfEnergiesStandBesideTemperatures) {
  EXPECT_NEAR(number_in("T > 1 keV"), 1.602176634e-9 / 1.380649e-16, 1);
}

// They would be compared as if h were 1.
TEST(NumbersWithUnits, AreRefusedWhereTheFieldsUnitHasAnUnknownFactor) {
  const auto in_units_of_h = [](const std::string&) { return written_unit("kpc/h", {1, 0}); };
  EXPECT_THAT(
      [&] {
        with_converted_numbers(Formula::parse("r < 2 Mpc", "here"), in_units_of_h, {1, 0}, "here");
      },
      ThrowsMessage<UsageError>(HasSubstr("h")));
  EXPECT_NO_THROW(
      with_converted_numbers(Formula::parse("r < 2", "here"), in_units_of_h, {1, 0}, "here"));
}

}  // namespace
}  // namespace splotchcl::test
