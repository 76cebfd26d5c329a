// The functions of kernels/composite/gaussian.cl and shape.cl, and log2_positive() of
// kernels/common/lanes.cl, keep the errors that their comments name.
#include "device/evenly_spread.h"
#include "device/opencl/launch.h"
#include "device/stages.h"
#include "scene/plan/splat_limits.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr const char* shape_kernel = R"(
__kernel void evaluate(__global const float* x, __global float* results) {
  const uint i = get_global_id(0);
  STORE(FUNCTION(LOAD(x + LANES * i)), results + LANES * i);
}
)";

// Eight lanes or one.
class ShapeFunctions : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  std::vector<float> evaluate(const std::string& function, Precision precision,
                              const std::vector<float>& x, const std::string& more = "") {
    const std::string is_full = precision == Precision::full ? "1" : "0";
    const std::string defines = "#define FUNCTION " + function + "\n#define FULL_PRECISION " +
                                is_full + "\n#define NATIVE_EXP2 0\n" +
                                (GetParam() ? "#define LANES_8\n" : "") + more;
    const Program program =
        device().programs.get({"kernels/composite/shape.cl", defines, "", shape_kernel});
    const auto results = device().pool.get<float>(x.size(), "result");
    Launch(device(), "test", program.create_kernel("evaluate"))
        .arg(device().pool.upload(x, "argument"))
        .arg(results)
        .run_items(x.size() / (GetParam() ? 8 : 1));
    return device().pool.download(results, x.size());
  }
};

double largest(const std::vector<float>& x, const std::vector<float>& found,
               const std::function<double(double found, double x)>& error) {
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    most =
        std::max(most, std::abs(error(static_cast<double>(found[i]), static_cast<double>(x[i]))));
  }
  return most;
}

TEST_P(ShapeFunctions, ErrorFunctionErrsByWhatPlansCountOn) {
  const std::vector<float> x = evenly_spread(-6, 6, 1 << 16);
  const auto error = [](double found, double at) { return found - std::erf(at); };
  EXPECT_LE(largest(x, evaluate("error_function", Precision::fast, x), error), 2.3e-6);
  EXPECT_LE(largest(x, evaluate("error_function", Precision::full, x), error), 2.3e-7);
}

// Means along one axis: what is computed, at every fourth of a pixel from the center on.
struct Means {
  std::vector<double> found, exact;
};

// The largest error of their products, over the peak.
double largest_error_of_means(const Means& means) {
  double most = 0;
  for (std::size_t i = 0; i < means.found.size(); ++i) {
    for (std::size_t k = i; k < means.found.size(); ++k)
      most = std::max(most,
                      std::abs(means.found[i] * means.found[k] - means.exact[i] * means.exact[k]));
  }
  return most;
}

std::vector<float> fourths_of_pixels(int count) {
  std::vector<float> places;
  for (int i = 0; i < count; ++i)
    places.push_back(0.25f * static_cast<float>(i));
  return places;
}

double exact_mean(double place, double sigma) {
  const double left = (place - 0.5) / sigma, right = (place + 0.5) / sigma;
  return 0.5 * std::sqrt(3.141592653589793) * sigma * (std::erf(right) - std::erf(left));
}

TEST_P(ShapeFunctions, MeansByErfErrByTheirPartOfAPeakForEachSigma) {
  for (const Precision precision : {Precision::fast, Precision::full}) {
    for (double sigma = 0.5; sigma < 2; sigma *= 1.07) {
      std::vector<float> edges;
      for (const float place : fourths_of_pixels(96))
        edges.push_back((place - 0.5f) / static_cast<float>(sigma));
      const std::vector<float> erf = evaluate("error_function", precision, edges);
      Means means;
      for (std::size_t i = 0; i + 4 < erf.size(); ++i) {
        const double left = static_cast<double>(erf[i]), right = static_cast<double>(erf[i + 4]);
        means.found.push_back(0.5 * std::sqrt(3.141592653589793) * sigma * (right - left));
        means.exact.push_back(exact_mean(0.25 * static_cast<double>(i), sigma));
      }
      EXPECT_LE(largest_error_of_means(means), sigma * error_of_means(precision)) << sigma;
    }
  }
}

TEST_P(ShapeFunctions, MeansOfBrightSplatsErrByTheirPartOfAPeak) {
  const std::vector<float> places = fourths_of_pixels(128);
  for (const double sigma : {0.5, 0.9, 1.4, 2.0, 2.9, 3.8, 3.9, 4.0, 6.0, 9.0, 40.0}) {
    const std::string define =
        "#define BRIGHT_MEAN(d) bright_mean(d, " + std::to_string(sigma) + "f)\n";
    Means means;
    for (const float value : evaluate("BRIGHT_MEAN", Precision::fast, places, define))
      means.found.push_back(static_cast<double>(value));
    for (const float place : places)
      means.exact.push_back(exact_mean(static_cast<double>(place), sigma));
    EXPECT_LE(largest_error_of_means(means), bright_mean_error(sigma, sigma)) << sigma;
  }
}

// Beside the peak, where a splat of so much light has faded to 1.
TEST_P(ShapeFunctions, MeansOfBrightSplatsErrByAPartOfThemselves) {
  constexpr double light = 1e6;
  for (const double sigma : {0.5, 0.9, 2.0, 3.8, 3.9, 4.0, 9.0, 40.0}) {
    const std::string define =
        "#define BRIGHT_MEAN(d) bright_mean(d, " + std::to_string(sigma) + "f)\n";
    const std::vector<float> places = evenly_spread(0, sigma * std::sqrt(std::log(light)), 1 << 12);
    const auto error = [&](double found, double at) {
      const double left = (at - 0.5) / sigma, right = (at + 0.5) / sigma;
      const double beyond =
          left < 0 ? std::erf(right) - std::erf(left) : std::erfc(left) - std::erfc(right);
      return found / (0.5 * std::sqrt(3.141592653589793) * sigma * beyond) - 1;
    };
    EXPECT_LE(2 * largest(places, evaluate("BRIGHT_MEAN", Precision::fast, places, define), error),
              part_of_bright_mean(sigma, sigma, light))
        << sigma;
  }
}

TEST_P(ShapeFunctions, ErrorFunctionLosesNoLightOfAGrain) {
  const std::vector<float> far = evenly_spread(4, 100, 64);
  const auto error = [](double found, double) { return found - 1; };
  EXPECT_LE(largest(far, evaluate("error_function", Precision::fast, far), error), 2.3e-7);
}

TEST_P(ShapeFunctions, ComplementOfTheErrorFunctionErrsByPartsOfItself) {
  const std::vector<float> x = evenly_spread(0, 9.1, 1 << 16);
  const auto error = [](double found, double at) { return found / std::erfc(at) - 1; };
  EXPECT_LE(largest(x, evaluate("complement_of_erf", Precision::fast, x), error), 5e-7);
}

TEST_P(ShapeFunctions, PowersOfTwoErrByThePartsThatPlansCountOn) {
  const std::vector<float> x = evenly_spread(-60, 0, 1 << 16);
  const auto error = [](double found, double at) { return found / std::exp2(at) - 1; };
  EXPECT_LE(largest(x, evaluate("exp2_negative", Precision::fast, x), error), 2.7e-6);
  EXPECT_LE(largest(x, evaluate("exp2_negative", Precision::full, x), error), 7.5e-8);
}

TEST_P(ShapeFunctions, LogarithmsErrByARoundingAndTheirPolynomial) {
  const auto beyond_rounding = [](double found, double at) {
    const double exact = std::log2(at);
    return std::max(std::abs(found - exact) - 0x1p-24 * std::abs(exact), 0.0);
  };
  for (const auto& [first, last] : {std::pair{0.6, 1.6}, {1e-3, 1e3}, {1e-30, 1e30}}) {
    const std::vector<float> x = evenly_spread(first, last, 1 << 16);
    EXPECT_LE(largest(x, evaluate("log2_positive", Precision::fast, x), beyond_rounding), 8e-8)
        << first;
  }
}

TEST_P(ShapeFunctions, LogarithmsOfNumbersNearOneErrByPartsOfThemselves) {
  const std::vector<float> x = evenly_spread(1.00001, 1.01, 1 << 16);
  const auto part = [](double found, double at) { return found / std::log2(at) - 1; };
  EXPECT_LE(largest(x, evaluate("log2_positive", Precision::fast, x), part), 3e-7);
}

// Of kernels/common/double_lanes.cl and kernels/composite/extended_means.cl.
class DoubleLanes : public StageTest {
 protected:
  // The largest part of itself by which `function` errs at these.
  double largest_part(const std::string& function, const std::vector<float>& x,
                      const std::function<double(double)>& exact) {
    const Program program = device().programs.get(
        {"kernels/composite/extended_means.cl",
         "#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n#define TILE_WIDTH 64\n#define FUNCTION " +
             function + "\n",
         "",
         R"(
__kernel void evaluate(__global const float* x, __global double* results) {
  const uint i = get_global_id(0);
  vstore8(FUNCTION(convert_double8(vload8(i, x))), i, results);
}
)"});
    const auto results = device().pool.get<double>(x.size(), "result");
    Launch(device(), "test", program.create_kernel("evaluate"))
        .arg(device().pool.upload(x, "argument"))
        .arg(results)
        .run_items(x.size() / 8);
    const std::vector<double> found = device().pool.download(results, x.size());
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      most = std::max(most, std::abs(found[i] / exact(static_cast<double>(x[i])) - 1));
    return most;
  }
};

TEST_F(DoubleLanes, ErrByThePartsThatTheirCommentsName) {
  if (!device().traits.double_numbers) GTEST_SKIP() << "the device has no double precision";
  EXPECT_LE(largest_part("exp_of_minus", evenly_spread(-700, 700, 1 << 16),
                         [](double y) { return std::exp(-y); }),
            1e-14);
  EXPECT_LE(largest_part("complement_of_erf", evenly_spread(0, 10, 1 << 16),
                         [](double x) { return std::erfc(x); }),
            2e-13);
  // y^5 / 720 of a phi of 0.985, at 0.03.
  EXPECT_LE(largest_part("phi_of_thin", evenly_spread(1e-6, 0.03, 1 << 16),
                         [](double y) { return -std::expm1(-y) / y; }),
            3.43e-11);
}

// Means of wide splats, of kernels/composite/extended_means.cl.
class WideMeans : public StageTest {
 protected:
  std::vector<double> means(float first, float sigma, std::size_t pixels) {
    const Program program = device().programs.get(
        {"kernels/composite/extended_means.cl",
         "#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n#define TILE_WIDTH 64\n", "",
         R"(
__kernel void evaluate(float first, float sigma, int pixels, __global double* results) {
  double values[TILE_WIDTH];
  fill_wide_means(values, first, 0, pixels, sigma);
  for (int k = 0; k < pixels; ++k)
    results[k] = are_wide_means(sigma, max(fabs(first), fabs(first + pixels))) ? values[k] : -1;
}
)"});
    const auto results = device().pool.get<double>(pixels, "result");
    Launch(device(), "test", program.create_kernel("evaluate"))
        .value(first)
        .value(sigma)
        .value(static_cast<cl_int>(pixels))
        .arg(results)
        .run_items(1);
    return device().pool.download(results, pixels);
  }
};

// exact_mean() to all digits far out.
double exact_mean_beside(double distance, double sigma) {
  const double near = (distance - 0.5) / sigma, far = (distance + 0.5) / sigma;
  return 0.5 * std::sqrt(3.141592653589793) * sigma * (std::erfc(near) - std::erfc(far));
}

TEST_F(WideMeans, ErrByTwoPartsInABillionOfThemselves) {
  if (!device().traits.double_numbers) GTEST_SKIP() << "the device has no double precision";
  for (const float sigma : {3.31F, 6.5F, 10.0F, 40.0F, 1000.0F}) {
    // As far out as a splat may be drawn, and on both sides of its center.
    const float farthest = std::min(1.74F * sigma * sigma, 24.9F * sigma);
    const std::size_t pixels = sigma < 6 ? 16 : 64;
    const auto width = static_cast<float>(pixels);
    for (const float first : {-farthest, 0.3F - 0.5F * width, farthest - width}) {
      const std::vector<double> found = means(first, sigma, pixels);
      for (std::size_t k = 0; k < pixels; ++k) {
        const double distance = std::abs(static_cast<double>(first) + static_cast<double>(k));
        EXPECT_NEAR(found[k] / exact_mean_beside(distance, static_cast<double>(sigma)), 1, 2e-9)
            << sigma << " pixels wide, " << distance << " from the center";
      }
    }
  }
}

TEST_F(WideMeans, AreNotTakenOfNarrowSplatsNorTooFarOut) {
  if (!device().traits.double_numbers) GTEST_SKIP() << "the device has no double precision";
  EXPECT_EQ(means(-4, 3.0F, 8)[0], -1) << "narrow";
  EXPECT_EQ(means(200, 8.0F, 8)[0], -1) << "the slope is too steep for the series";
  EXPECT_NE(means(-4, 8.0F, 8)[0], -1);
}

INSTANTIATE_TEST_SUITE_P(Lanes, ShapeFunctions, testing::Bool(),
                         [](const testing::TestParamInfo<bool>& info) {
                           return info.param ? "eight" : "one";
                         });

}  // namespace
}  // namespace splotchcl::test
