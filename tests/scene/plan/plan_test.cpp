#include "splotchcl/plan.h"

#include "reference/frames.h"
#include "scene/plan/grid_filters.h"
#include "testing.h"

namespace splotchcl {
namespace {

using Kind = Absorption::Kind;

DrawnComponent component(Kind kind, double factor = 0) {
  DrawnComponent component;
  component.palette.emission = {{1, 1, 1}};
  component.absorption = {kind, factor};
  return component;
}

DrawnComponent with_own_absorption(DrawnComponent component) {
  component.palette.absorption = component.palette.emission;
  return component;
}

Frame frame_of(const std::vector<DrawnComponent>& components) {
  Frame frame;
  frame.components = components;
  return frame;
}

LightPlan light_of(const std::vector<DrawnComponent>& components) {
  return choose_light(frame_of(components));
}

TEST(Plan, AddsUpEmissionWhereNothingAbsorbs) {
  EXPECT_EQ(light_of({component(Kind::none)}), LightPlan::emission);
  EXPECT_EQ(light_of({component(Kind::none), component(Kind::none)}), LightPlan::emission);
}

TEST(Plan, AddsUpEmissionWhereThePalettesAbsorptionIsSwitchedOff) {
  EXPECT_EQ(light_of({with_own_absorption(component(Kind::none))}), LightPlan::emission);
}

TEST(Plan, NeedsNoOrderWhereEverythingAbsorbsWhatItEmits) {
  DrawnComponent bright = component(Kind::as_emission);
  bright.brightness = 7;
  const FramePlan plan = make_plan(frame_of({component(Kind::as_emission), bright}));
  EXPECT_EQ(plan.light, LightPlan::proportional);
  EXPECT_EQ(plan.source, (std::array<double, 3>{1, 1, 1}));
}

// Sums are of A w, of which single precision holds nothing there, or of E w, which is as far beyond
// it.
TEST(Plan, NeedsAnOrderWhereSinglePrecisionDoesNotHoldBothEmissionAndAbsorption) {
  EXPECT_EQ(light_of({component(Kind::factor, 1e-17)}), LightPlan::proportional);
  EXPECT_EQ(light_of({component(Kind::factor, 1e-36)}), LightPlan::ordered);
  EXPECT_EQ(light_of({component(Kind::factor, 1e36)}), LightPlan::ordered);
}

TEST(Plan, NeedsNoOrderWhereOneComponentAbsorbsAFactorOfWhatItEmits) {
  DrawnComponent gas = component(Kind::factor, 4);
  gas.brightness = 3;
  const FramePlan plan = make_plan(frame_of({gas}));
  EXPECT_EQ(plan.light, LightPlan::proportional);
  // E = brightness I palette, A = factor I palette.
  EXPECT_EQ(plan.source, (std::array<double, 3>{0.75, 0.75, 0.75}));
}

TEST(Plan, NeedsNoOrderWhereAllComponentsHaveTheSameSource) {
  DrawnComponent gas = component(Kind::factor, 4);
  gas.brightness = 12;
  DrawnComponent dust = component(Kind::factor, 0.2);
  dust.brightness = 0.6;  // 0.6 / 0.2 is not quite 3 in binary digits
  const FramePlan plan = make_plan(frame_of({gas, dust}));
  EXPECT_EQ(plan.light, LightPlan::proportional);
  EXPECT_EQ(plan.source, (std::array<double, 3>{3, 3, 3}));
}

TEST(Plan, NeedsNoOrderWhereAFactorIsWhatIsEmitted) {
  DrawnComponent gas = component(Kind::factor, 4);
  gas.brightness = 4;
  EXPECT_EQ(light_of({gas, component(Kind::as_emission)}), LightPlan::proportional);
}

TEST(Plan, OrdersComponentsOfDifferentSources) {
  EXPECT_EQ(light_of({component(Kind::factor, 4), component(Kind::factor, 4.0001)}),
            LightPlan::ordered);
  EXPECT_EQ(light_of({component(Kind::factor, 4), component(Kind::as_emission)}),
            LightPlan::ordered);
}

TEST(Plan, OrdersWhatEmitsAndAbsorbsByItsOwnColors) {
  EXPECT_EQ(light_of({with_own_absorption(component(Kind::as_emission))}), LightPlan::ordered);
  EXPECT_EQ(light_of({with_own_absorption(component(Kind::factor, 1))}), LightPlan::ordered);
}

TEST(Plan, OrdersGrayAbsorption) {
  EXPECT_EQ(light_of({component(Kind::gray, 0.2)}), LightPlan::ordered);
}

TEST(Plan, OrdersComponentsThatAbsorbDifferently) {
  const std::vector<DrawnComponent> kinds = {component(Kind::as_emission), component(Kind::none),
                                             component(Kind::factor, 2), component(Kind::gray, 1)};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = 0; j < kinds.size(); ++j) {
      if (i == j) continue;
      EXPECT_EQ(light_of({kinds[i], kinds[j]}), LightPlan::ordered) << i << " and " << j;
    }
  }
}

TEST(Plan, SortsOnlyWhatItOrders) {
  EXPECT_FALSE(make_plan(frame_of({component(Kind::none)})).needs_sort());
  EXPECT_FALSE(make_plan(frame_of({component(Kind::as_emission)})).needs_sort());
  EXPECT_TRUE(make_plan(frame_of({component(Kind::gray, 1)})).needs_sort());
}

TEST(Plan, SharesOutTheWholeTolerance) {
  for (const Kind kind : {Kind::none, Kind::as_emission, Kind::gray}) {
    for (const double tolerance : {0.0, 1e-8, 1e-6, 1e-3, 1.0}) {
      Frame frame = frame_of({component(kind, 1)});
      frame.tolerance = tolerance;
      const FramePlan plan = make_plan(frame);
      const ToleranceShares& shares = plan.shares;
      EXPECT_GE(shares.truncation, 0);
      EXPECT_GE(shares.coarse_grids, 0);
      EXPECT_GE(shares.pixel_mean, 0);
      EXPECT_GE(shares.phi, 0);
      EXPECT_GE(shares.early_stop, 0);
      EXPECT_GE(shares.slabs, 0);
      // Tolerances below what tolerance 0 promises share that out instead.
      const double promise = std::max(tolerance, extended_tolerance);
      EXPECT_EQ(shares.promise, promise);
      EXPECT_NEAR(shares.truncation + shares.coarse_grids + shares.pixel_mean + shares.phi +
                      shares.early_stop + shares.slabs,
                  promise, 1e-15 * promise);
    }
  }
}

// Cut values at pixel centers, as the original program draws them, leave nothing out.
TEST(Plan, HasErrorsOfSplatsUnlessTheyAreCutValuesAtPixelCentersAlone) {
  Frame frame = frame_of({component(Kind::none)});
  frame.kernel.sampling = Sampling::center;
  EXPECT_TRUE(make_plan(frame).has_errors_of_splats) << "where they end";
  frame.kernel.cut = 1.8;
  EXPECT_FALSE(make_plan(frame).has_errors_of_splats);
  EXPECT_TRUE(make_plan(frame, {true, -1, true}).has_errors_of_splats) << "a bound has roundings";
  frame.kernel.sampling = Sampling::mean;
  EXPECT_TRUE(make_plan(frame).has_errors_of_splats) << "of means";
  frame.kernel.sampling = Sampling::center;
  frame.tolerance = 0.1;
  frame.width = frame.height = 200;
  EXPECT_TRUE(make_plan(frame).has_errors_of_splats) << "of coarse grids";
  frame.tolerance = 0;
  EXPECT_FALSE(make_plan(frame).has_errors_of_splats) << "none at tolerance 0";
}

// Smaller tolerances need wider blurs, and the kernels' arguments hold so many weights only.
TEST(Plan, BlursByNoMoreWeightsThanKernelsTake) {
  bool blurs = false;
  for (double tolerance = 1; tolerance > 1e-9; tolerance *= 0.8) {
    Frame frame = frame_of({component(Kind::none)});
    frame.tolerance = tolerance;
    const GridPyramid pyramid = make_plan(frame).pyramid;
    if (!pyramid.is_blurred()) continue;
    blurs = true;
    for (const double sigma2 : pyramid.blurs)
      EXPECT_LE(blur_weights(sigma2, pyramid.blur_error).size(), most_blur_weights) << tolerance;
  }
  EXPECT_TRUE(blurs);
}

TEST(Plan, HasNoCoarseGridsWhereOrderMatters) {
  const FramePlan plan = make_plan(frame_of({component(Kind::gray, 1)}));
  EXPECT_EQ(plan.shares.coarse_grids, 0);
  EXPECT_EQ(plan.pyramid.grids.size(), 1u);
}

// So many clouds before the camera, each of this optical depth.
Frame many_layers(std::size_t count, float depth) {
  DrawnComponent clouds = component(Kind::gray, 0.2);
  std::vector<float> positions(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    positions[3 * i + 2] = 10 + static_cast<float>(i % 100);
  clouds.particles.count = count;
  clouds.particles.position = Column::owning(std::move(positions));
  clouds.particles.smoothing_length = Column::uniform(30);
  clouds.brightness = static_cast<double>(depth);
  Frame frame = test::empty_frame(64, 64);
  frame.components = {clouds};
  return frame;
}

TEST(Plan, DrawsLargeDimOrderedFramesInSlabs) {
  constexpr std::size_t many = std::size_t{1} << 20;
  const FramePlan plan = make_plan(many_layers(many, 1e-3F));
  EXPECT_GT(plan.slabs, 1);
  EXPECT_GT(plan.pyramid.grids.size(), 1U);
  EXPECT_EQ(make_plan(many_layers(1000, 1e-3F)).slabs, 0) << "few particles";
  Frame narrow = many_layers(many, 1e-3F);
  narrow.components.front().particles.smoothing_length = Column::uniform(1e-3F);
  EXPECT_EQ(make_plan(narrow).slabs, 0) << "few wide splats";
  EXPECT_EQ(make_plan(many_layers(many, 1e3F)).slabs, 0) << "bright sources";
}

TEST(Plan, DrawsInOrderWhatMayNotBeDrawnInSlabs) {
  Frame frame = many_layers(std::size_t{1} << 20, 1e-3F);
  PlanOptions certified;
  certified.certify = true;
  EXPECT_EQ(make_plan(frame, certified).slabs, 0);
  frame.tolerance = 1e-4;
  EXPECT_EQ(make_plan(frame).slabs, 0) << "small tolerances";
  frame.tolerance = 1e-3;
  frame.kernel.cut = 1.8;
  EXPECT_EQ(make_plan(frame).slabs, 0) << "cut kernels";
}

TEST(Plan, TakesMoreSlabsUntilOrderIsCheaper) {
  const Frame frame = many_layers(std::size_t{1} << 20, 1e-3F);
  const FramePlan plan = make_plan(frame);
  SplatNeeds needs;
  needs.slabs = plan.slabs + 3;
  EXPECT_EQ(refine_plan(frame, plan, needs).slabs, plan.slabs + 3);
  needs.slabs = 1000;
  const FramePlan ordered = refine_plan(frame, plan, needs);
  EXPECT_EQ(ordered.slabs, 0);
  EXPECT_EQ(ordered.shares.coarse_grids, 0);
  EXPECT_EQ(ordered.pyramid.grids.size(), 1U);
}

TEST(Plan, TakesThePrecisionThatTheToleranceNeeds) {
  Frame frame = frame_of({component(Kind::none)});
  const auto precision_at = [&frame](double tolerance) {
    frame.tolerance = tolerance;
    return make_plan(frame).precision;
  };
  EXPECT_EQ(precision_at(1e-3), Precision::fast);
  EXPECT_EQ(precision_at(1e-4), Precision::full);
  EXPECT_EQ(precision_at(0), Precision::extended);
  frame.projection = Projection::fisheye;
  EXPECT_EQ(precision_at(0), Precision::extended);
}

TEST(Plan, ExplainsItselfByName) {
  for (const Kind kind : {Kind::none, Kind::as_emission, Kind::gray}) {
    const Frame frame = frame_of({component(kind, 1)});
    const FramePlan plan = make_plan(frame);
    EXPECT_THAT(explain(plan, frame), HasSubstr(std::string("plan: ") + name(plan.light)));
  }
}

TEST(Plan, ExplainsWhatItSortsBy) {
  Frame frame = frame_of({component(Kind::gray, 1)});
  EXPECT_THAT(explain(make_plan(frame), frame), HasSubstr("sort by depth"));
  frame.sort.by = SortOrder::By::field;
  frame.sort.field = "temperature";
  EXPECT_THAT(explain(make_plan(frame), frame), HasSubstr("sort by temperature"));
}

}  // namespace
}  // namespace splotchcl
