// Every hard case in every plan it applies to and both shapes of compositing, against its
// exact picture; a table of the measured errors at the end.
#include "hard_cases/hard_cases.h"

#include "device/scenes.h"
#include "hard_cases/error_table.h"
#include "splotchcl/renderer.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

const std::vector<HardCase>& all_cases() {
  static const std::vector<HardCase> cases = [] {
    std::vector<HardCase> all;
    for (const auto& part :
         {light_cases(), source_cases(), color_cases(), layer_cases(), order_cases(), size_cases(),
          camera_cases(), picture_cases(), data_cases(), promise_cases(), wide_angle_cases()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return cases;
}

// How the device draws: either shape of compositing at the case's own tolerance, or the most
// exact mode in either shape; or in rows, until a bound says that the tolerance is kept, or in
// slabs where the plan sorts.
enum class Way { rows, groups, exact, exact_groups, certified, slabs };

struct CaseRun {
  std::size_t index;
  LightPlan plan;
  Way way;
};

bool is_drawn(Drawn when) {
  return when == Drawn::always || (when == Drawn::in_long_tests && long_tests());
}

std::vector<CaseRun> all_runs() {
  std::vector<CaseRun> runs;
  for (std::size_t i = 0; i < all_cases().size(); ++i) {
    const std::vector<LightPlan>& plans = all_cases()[i].plans;
    for (const LightPlan plan : plans) {
      // Devices that few have. Their programs take longest: short tests have each case in one plan.
      const bool is_sampled = long_tests() || plan == plans[i % plans.size()];
      const bool groups = is_sampled && is_drawn(all_cases()[i].in_groups);
      const bool exact = is_drawn(all_cases()[i].most_exactly);
      runs.push_back({i, plan, Way::rows});
      if (plan != LightPlan::ordered || is_drawn(all_cases()[i].certified_in_order))
        runs.push_back({i, plan, Way::certified});
      if (plan == LightPlan::ordered) runs.push_back({i, plan, Way::slabs});
      if (groups) runs.push_back({i, plan, Way::groups});
      if (exact) runs.push_back({i, plan, Way::exact});
      if (groups && exact) runs.push_back({i, plan, Way::exact_groups});
    }
  }
  return runs;
}

const char* way_name(const CaseRun& run) {
  switch (run.way) {
    case Way::rows:
      return "rows";
    case Way::groups:
      return "groups";
    case Way::exact:
      return "exact";
    case Way::exact_groups:
      return "exact_groups";
    case Way::certified:
      return "certified";
    case Way::slabs:
      return "slabs";
  }
  return "";
}

bool is_exact(const CaseRun& run) {
  return run.way == Way::exact || run.way == Way::exact_groups;
}

std::string run_name(const CaseRun& run) {
  return all_cases()[run.index].name + "_" + name(run.plan) + "_" + way_name(run);
}

// What all runs share: a renderer per shape, the last exact picture, and the table.
class Bench : public testing::Environment {
 public:
  Renderer& renderer(Way way) {
    std::unique_ptr<Renderer>& renderer = renderers_[static_cast<std::size_t>(way)];
    if (!renderer) {
      RendererOptions options;
      const bool in_groups = way == Way::groups || way == Way::exact_groups;
      options.shape = in_groups ? CompositeShape::groups : CompositeShape::rows;
      options.certify = way == Way::certified;
      if (way == Way::slabs) options.slabs = 3;
      renderer = std::make_unique<Renderer>(options);
    }
    return *renderer;
  }

  // The ways to draw a case come one after the other and share the exact picture.
  const ReferenceImage& exact(const CaseRun& run, const Frame& frame) {
    const std::string key = all_cases()[run.index].name + name(run.plan);
    if (key != exact_key_) {
      exact_ = all_cases()[run.index].exact(frame);
      exact_key_ = key;
    }
    return exact_;
  }

  ErrorTable& table() { return table_; }

  void TearDown() override {
    table_.print(std::cout);
    for (std::unique_ptr<Renderer>& renderer : renderers_)
      renderer.reset();
  }

 private:
  std::unique_ptr<Renderer> renderers_[6];
  ReferenceImage exact_;
  std::string exact_key_;
  ErrorTable table_;
};

Bench& bench() {
  static auto* const shared = dynamic_cast<Bench*>(testing::AddGlobalTestEnvironment(new Bench));
  return *shared;
}

// No pixel errs by more than is certified of it, or by more than is estimated.
void expect_to_be_bounded(const Image& image, const ReferenceImage& exact, const FrameCheck& check,
                          bool has_bound) {
  ASSERT_EQ(check.is_bound, has_bound);
  EXPECT_LE(check.errors_of_promise.back(), 1);
  double largest = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t value = 4 * static_cast<std::size_t>(y * image.width + x) + c;
        const double error =
            std::abs(static_cast<double>(image.pixels[value]) - exact.pixels[value]) /
            std::max(1.0, std::abs(exact.pixels[value]));
        const auto certified = static_cast<double>(check.blocks.at(x, y));
        if (error != 0 || certified != 0) largest = larger(largest, error / certified);
      }
    }
  }
  EXPECT_LE(largest, 1) << "a pixel errs by so many times what is certified of it";
}

// Alpha is no light, and the tolerance says less of it (docs/accuracy.md). Closed forms have none.
double largest_opacity_error(const Image& image, const ReferenceImage& exact) {
  double largest = 0;
  for (std::size_t i = 3; i < exact.pixels.size(); i += 4) {
    if (std::isnan(exact.pixels[i])) continue;
    largest = larger(largest, std::abs(static_cast<double>(image.pixels[i]) - exact.pixels[i]));
  }
  return largest;
}

class HardCases : public testing::TestWithParam<CaseRun> {};

TEST_P(HardCases, StayWithinTheirBound) {
  const CaseRun& run = GetParam();
  const HardCase& hard = all_cases()[run.index];
  Frame frame = hard.frame(run.plan);
  ASSERT_EQ(choose_light(frame), run.plan);
  if (is_exact(run)) frame.tolerance = 0;
  const double bound = is_exact(run) ? extended_tolerance : frame.tolerance;
  Renderer& renderer = bench().renderer(run.way);
  const Image image = renderer.render(frame);
  const ReferenceImage& exact = bench().exact(run, frame);
  ASSERT_EQ(largest_value(exact) < 0.05, hard.dark) << "the case must have something to see";
  const double error = largest_error(image, exact);
  bench().table().add(hard, run.plan, way_name(run), error, bound);
  EXPECT_LE(error, bound) << hard.why;
  EXPECT_LE(largest_opacity_error(image, exact), 10 * bound) << hard.why;
  if (run.way == Way::certified)
    expect_to_be_bounded(image, exact, renderer.stats().check, hard.has_bound);
}

INSTANTIATE_TEST_SUITE_P(All, HardCases, testing::ValuesIn(all_runs()),
                         [](const testing::TestParamInfo<CaseRun>& info) {
                           return run_name(info.param);
                         });

}  // namespace
}  // namespace splotchcl::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  splotchcl::test::bench();
  return RUN_ALL_TESTS();
}
