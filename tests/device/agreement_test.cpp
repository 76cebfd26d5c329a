// The device's pictures against the oracle's, in every plan and both shapes of
// compositing, within the tolerance that the frame promises.
#include "device/cases.h"
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

struct Clouds {
  const char* name;
  CloudSetup setup;
  std::function<void(Frame&)> change = [](Frame&) {};
};

CloudSetup clouds(int count, double sigma_low, double sigma_high, double column_low,
                  double column_high) {
  return {count, 100, 70, sigma_low, sigma_high, column_low, column_high};
}

Clouds of_size(const char* name, int width, int height) {
  return {name, {500, width, height, 0.05, 30, 0.1}};
}

Clouds with_tolerance(const char* name, double tolerance) {
  return {name, clouds(2000, 0.5, 30, 1e-3, 1e-1),
          [tolerance](Frame& frame) { frame.tolerance = tolerance; }};
}

const Clouds kinds_of_clouds[] = {{"of_all_sizes", {}},
                                  {"of_grains_below_a_pixel", clouds(3000, 0.01, 1, 0.01, 1)},
                                  {"that_are_wide_and_thin", clouds(3000, 5, 80, 1e-4, 1e-2)},
                                  {"that_are_opaque", clouds(300, 0.05, 30, 1, 100)},
                                  {"on_a_background",
                                   {},
                                   [](Frame& frame) {
                                     frame.background = {0.2, 0.5, 0.9};
                                   }},
                                  {"sampled_at_centers", clouds(500, 0.5, 30, 0.01, 1),
                                   [](Frame& frame) { frame.kernel.sampling = Sampling::center; }},
                                  with_tolerance("at_1e_2", 1e-2),
                                  with_tolerance("at_1e_4", 1e-4),
                                  with_tolerance("at_1e_5", 1e-5),
                                  of_size("in_a_pixel", 1, 1),
                                  of_size("in_a_column", 1, 131),
                                  of_size("in_a_row", 97, 1),
                                  of_size("in_33_by_17", 33, 17),
                                  of_size("in_32_by_16", 32, 16)};

class Agreement : public PictureTest,
                  public testing::WithParamInterface<std::tuple<Clouds, PlanAndShape>> {
 protected:
  const Clouds& clouds_ = std::get<0>(GetParam());
  const LightPlan light_ = std::get<0>(std::get<1>(GetParam()));
  const CompositeShape shape_ = std::get<1>(std::get<1>(GetParam()));

  Frame frame() const {
    Frame frame = clouds_for(light_, clouds_.setup);
    clouds_.change(frame);
    EXPECT_EQ(choose_light(frame), light_);
    return frame;
  }
};

TEST_P(Agreement, HoldsForClouds) {
  const ReferenceImage exact = reference::render(frame());
  EXPECT_GT(largest_value(exact), 0.05) << "the scene must have something to see";
  EXPECT_LE(largest_error(draw(frame(), shape_), exact), frame().tolerance);
}

std::string name_of_clouds(const testing::TestParamInfo<Agreement::ParamType>& info) {
  return std::get<0>(info.param).name + ("_" + name_of_case({std::get<1>(info.param), 0}));
}

INSTANTIATE_TEST_SUITE_P(Plans, Agreement,
                         testing::Combine(testing::ValuesIn(kinds_of_clouds),
                                          testing::Combine(testing::ValuesIn(all_plans),
                                                           both_shapes())),
                         name_of_clouds);

using PlansAgree = PictureTest;

TEST_F(PlansAgree, SameFrameGivesTheSameBitsWhoeverDrawsIt) {
  for (const CompositeShape shape : {CompositeShape::rows, CompositeShape::groups}) {
    for (const LightPlan plan : all_plans) {
      const Frame frame = clouds_for(plan);
      Renderer another({"", shape});
      EXPECT_EQ(draw(frame, shape).pixels, another.render(frame).pixels);
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
