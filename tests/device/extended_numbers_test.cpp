// The functions of kernels/extended/extended.cl and precise.cl keep the errors that their comments
// name, in double precision and in pairs of floats.
#include "device/evenly_spread.h"
#include "device/opencl/launch.h"
#include "device/stages.h"
#include "reference/frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Work-item i: the function of x[i], as a pair.
constexpr const char* extended_kernel = R"(
__kernel void evaluate(__global const float* x, __global float* results) {
  const uint i = get_global_id(0);
  const Extended value = FUNCTION;
  results[2 * i] = high_part(value);
  results[2 * i + 1] = low_part(value);
}
)";
constexpr const char* precise_kernel = R"(
__kernel void evaluate(__global const float* x, __global float* results) {
  const uint i = get_global_id(0);
  results[2 * i] = FUNCTION;
  results[2 * i + 1] = 0.0f;
}
)";

// Numbers of either kind: true for double precision.
class ExtendedNumbers : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  std::vector<double> evaluate(const std::string& function, const char* kernel,
                               const std::vector<float>& x) {
    const std::string defines = "#define FUNCTION " + function +
                                "\n#define WIDE_ANGLE 1\n#define PROJECTION_FISHEYE 0\n#define "
                                "PROJECTION_EQUIRECTANGULAR 1\n"
                                "#define DOUBLE_NUMBERS " +
                                (GetParam() ? "1\n" : "0\n");
    const Program program =
        device().programs.get({"kernels/project/wide_angle_extended.cl", defines, "",
                               std::string("#include \"kernels/extended/precise.cl\"\n") + kernel});
    const auto results = device().pool.get<float>(2 * x.size(), "result");
    Launch(device(), "test", program.create_kernel("evaluate"))
        .arg(device().pool.upload(x, "argument"))
        .arg(results)
        .run_items(x.size());
    const std::vector<float> pairs = device().pool.download(results, 2 * x.size());
    std::vector<double> values;
    for (std::size_t i = 0; i < x.size(); ++i)
      values.push_back(static_cast<double>(pairs[2 * i]) + static_cast<double>(pairs[2 * i + 1]));
    return values;
  }

  // The largest error, relative to max(|f|, floor).
  double largest_error(const std::string& function, const std::vector<float>& x,
                       const std::function<double(double)>& f, double floor,
                       const char* kernel = extended_kernel) {
    const std::vector<double> values = evaluate(function, kernel, x);
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double expected = f(static_cast<double>(x[i]));
      const double error = std::abs(values[i] - expected) / std::max(std::abs(expected), floor);
      largest = std::isfinite(error) ? std::max(largest, error) : 1e300;
    }
    return largest;
  }
};

std::vector<float> logarithmically(double low, double high, int count) {
  std::vector<float> x;
  for (int i = 0; i <= count; ++i)
    x.push_back(static_cast<float>(low * std::pow(high / low, 1.0 * i / count)));
  return x;
}

TEST_P(ExtendedNumbers, Exp) {
  const auto f = [](double x) { return std::exp(x); };
  EXPECT_LE(
      largest_error("extended_exp(extended_of(x[i]))", evenly_spread(-70, 80, 5001), f, 1e-300),
      3e-9);
  EXPECT_LE(
      largest_error("extended_exp(extended_of(x[i]))", evenly_spread(-200, -70, 501), f, 1e-36), 1);
}

TEST_P(ExtendedNumbers, Erfc) {
  const auto f = [](double x) { return std::erfc(x); };
  EXPECT_LE(
      largest_error("extended_erfc(extended_of(x[i]))", evenly_spread(0, 8.5, 5001), f, 1e-300),
      5e-9);
  EXPECT_LE(
      largest_error("extended_erfc(extended_of(x[i]))", evenly_spread(8.5, 1000, 501), f, 1e-36),
      1);
}

TEST_P(ExtendedNumbers, Log) {
  const auto f = [](double x) { return std::log(x); };
  const std::string log = "extended_log(extended_of(x[i]))";
  EXPECT_LE(largest_error(log, logarithmically(1e-37, 3e38, 5000), f, 1), 8e-12);
  EXPECT_LE(largest_error(log, evenly_spread(0.5, 2, 1001), f, 1), 8e-12);
}

TEST_P(ExtendedNumbers, Asinh) {
  const auto f = [](double x) { return std::asinh(x); };
  for (const double sign : {-1.0, 1.0}) {
    std::vector<float> x = logarithmically(1e-30, 3e38, 5000);
    for (float& value : x)
      value *= static_cast<float>(sign);
    EXPECT_LE(largest_error("extended_asinh(extended_of(x[i]))", x, f, 1), 3e-11);
    EXPECT_LE(largest_error("extended_asinh(extended_of(x[i]))", x, f, 1e-300), 3e-10);
  }
}

// Sums, products, quotients and roots of numbers that single precision cannot hold.
TEST_P(ExtendedNumbers, Arithmetic) {
  const std::vector<float> x = logarithmically(1e-3, 1e3, 2000);
  const std::string third = "extended_quotient(extended_of(x[i]), extended_of(3.0f))";
  const auto near = [&](const std::string& function, double (*f)(double)) {
    return largest_error(function, x, f, 1e-300);
  };
  EXPECT_LE(near(third, [](double v) { return v / 3; }), 0x1p-45);
  EXPECT_LE(
      near("extended_sum(" + third + ", extended_of(7.0f))", [](double v) { return v / 3 + 7; }),
      0x1p-45);
  EXPECT_LE(near("extended_product(" + third + ", " + third + ")",
                 [](double v) { return v / 3 * (v / 3); }),
            0x1p-44);
  EXPECT_LE(near("extended_root(" + third + ")", [](double v) { return std::sqrt(v / 3); }),
            0x1p-44);
}

// A third of x[i] over 1, and the other way round, in all quadrants.
TEST_P(ExtendedNumbers, Atan2) {
  const std::string third = "extended_quotient(extended_of(x[i]), extended_of(3.0f))";
  for (const double sign : {-1.0, 1.0}) {
    const std::string one = sign < 0 ? "extended_of(-1.0f)" : "extended_of(1.0f)";
    for (std::vector<float> x : {logarithmically(1e-30, 1e30, 3000), evenly_spread(-6, 6, 5001)}) {
      EXPECT_LE(largest_error(
                    "extended_atan2(" + third + ", " + one + ")", x,
                    [&](double v) { return std::atan2(v / 3, sign); }, 1e-300),
                0x1p-42);
      EXPECT_LE(largest_error(
                    "extended_atan2(" + one + ", " + third + ")", x,
                    [&](double v) { return std::atan2(sign, v / 3); }, 1e-300),
                0x1p-42);
    }
  }
  const std::vector<double> both = {0, 0};
  EXPECT_EQ(evaluate("extended_atan2(extended_of(x[i]), extended_of(x[i]))", extended_kernel,
                     {0.0f, -0.0f}),
            both);
}

TEST_P(ExtendedNumbers, Hypotenuse) {
  const std::string third = "extended_quotient(extended_of(x[i]), extended_of(3.0f))";
  const auto f = [](double v) { return std::hypot(v / 3, 1.0); };
  EXPECT_LE(largest_error("extended_hypotenuse(" + third + ", extended_of(1.0f))",
                          logarithmically(1e-30, 1e30, 3000), f, 1e-300),
            0x1p-42);
  EXPECT_LE(largest_error("extended_hypotenuse(extended_of(-1.0f), " + third + ")",
                          evenly_spread(-6, 6, 3001), f, 1e-300),
            0x1p-42);
}

// The lengths of the rows that an equirectangular picture shows a cloud in.
TEST_P(ExtendedNumbers, RowLength) {
  const auto f = [](double m) { return std::exp(-m * m) + std::sqrt(pi) * m * std::erf(m); };
  const std::string function =
      "extended_row_length(extended_of(1.0f), extended_of(x[i]), extended_of(x[i]))";
  EXPECT_LE(largest_error(function, evenly_spread(0, 12, 5001), f, 1e-300), 4e-9);
  EXPECT_NEAR(f(9), std::sqrt(pi) * 9, 1e-13) << "where exp and erf are left out";
}

TEST_P(ExtendedNumbers, PreciseExpAndPhi) {
  const auto exp = [](double y) { return std::exp(-y); };
  const auto phi = [](double y) { return y > 0 ? -std::expm1(-y) / y : 1; };
  EXPECT_LE(largest_error("precise_exp_negative(x[i], 0.0f)", evenly_spread(0, 80, 5001), exp,
                          1e-300, precise_kernel),
            1.3e-7);
  // A division may err by 2.5 units of the last place (OpenCL 7.4); processors round it to half of
  // one.
  const double bound = 1.3e-7 + (device().traits.is_gpu ? 2 * 0x1p-23 : 0);
  EXPECT_LE(largest_error("precise_phi(x[i])", logarithmically(1e-30, 1e30, 5000), phi, 1e-300,
                          precise_kernel),
            bound);
  EXPECT_LE(
      largest_error("precise_phi(x[i])", evenly_spread(0, 5, 5001), phi, 1e-300, precise_kernel),
      bound);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExtendedNumbers, testing::Bool(),
                         [](const testing::TestParamInfo<bool>& info) {
                           return info.param ? "doubles" : "pairs";
                         });

}  // namespace
}  // namespace splotchcl::test
