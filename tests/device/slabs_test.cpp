// Ordered frames in slabs: wide clouds are added up and laid among the narrow ones.
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr double tolerance = 1e-3;

class Slabs : public testing::TestWithParam<CompositeShape> {
 protected:
  // Clouds of all widths at all depths.
  static Frame clouds_of_column(double column) {
    CloudSetup setup;
    setup.count = 300;
    setup.width = 96;
    setup.height = 80;
    setup.column_low = 0.01 * column;
    setup.column_high = column;
    DrawnComponent clouds = random_clouds(setup);
    clouds.absorption = {Absorption::Kind::gray, 0.2};
    Frame frame = frame_of(setup.width, setup.height, {clouds});
    frame.tolerance = tolerance;
    return frame;
  }

  Image draw(const Frame& frame, int slabs) {
    PlanOptions options;
    options.slabs = slabs;
    return renderer_.render(frame, make_plan(frame, options));
  }

  const FrameCheck& check() const { return renderer_.stats().check; }

 private:
  static RendererOptions drawing_slabs() {
    RendererOptions options;
    options.shape = GetParam();
    options.slabs = 1;
    return options;
  }

  Renderer renderer_{drawing_slabs()};
};

INSTANTIATE_TEST_SUITE_P(Shapes, Slabs,
                         testing::Values(CompositeShape::rows, CompositeShape::groups));

TEST_P(Slabs, KeepTheToleranceHoweverManyThereAre) {
  const Frame frame = clouds_of_column(0.02);
  const ReferenceImage exact = reference::render(frame);
  ASSERT_GT(largest_value(exact), 0.01) << "there must be something to see";
  for (const int slabs : {1, 2, 5}) {
    EXPECT_LE(largest_error(draw(frame, slabs), exact), tolerance) << slabs;
    ASSERT_EQ(check().errors_of_promise.size(), 1U) << "drawn again without them";
    EXPECT_GT(check().worst.slabs, 0) << slabs;
  }
}

TEST_P(Slabs, ErrLessTheMoreThereAre) {
  const Frame frame = clouds_of_column(0.02);
  draw(frame, 1);
  const double of_one = check().worst.slabs;
  draw(frame, 8);
  EXPECT_LT(check().worst.slabs, 0.5 * of_one);
}

TEST_P(Slabs, GiveWayToOrderWhereThePictureIsBright) {
  const Frame frame = clouds_of_column(1);
  const ReferenceImage exact = reference::render(frame);
  EXPECT_LE(largest_error(draw(frame, 1), exact), tolerance);
  EXPECT_GT(check().errors_of_promise.size(), 1U);
  EXPECT_EQ(check().worst.slabs, 0);
}

// A wide cloud behind a narrow one, both of them so dim that only first orders count.
TEST_P(Slabs, KnowWhatTheyChange) {
  DrawnComponent clouds =
      component_of({{48, 40, 10, 2, 0.02}, {48, 40, 20, 20, 0.02}}, two_colors());
  clouds.absorption = {Absorption::Kind::gray, 0.2};
  Frame frame = frame_of(96, 80, {clouds});
  frame.tolerance = tolerance;
  const ReferenceImage exact = reference::render(frame);
  const double error = largest_error(draw(frame, 1), exact);
  const double told = check().worst.slabs * tolerance;
  EXPECT_GT(told, 1e-5);
  EXPECT_LE(error, told + 0.3 * tolerance);
}

// Three clouds in one place, a wide one between two narrow ones: one slab cannot tell, three can.
TEST_P(Slabs, HaveTheOrderOfTheirDepths) {
  DrawnComponent clouds = component_of(
      {{48, 40, 10, 2, 0.1}, {48, 40, 20, 20, 0.1}, {48, 40, 30, 2, 0.1}}, two_colors());
  clouds.absorption = {Absorption::Kind::gray, 0.2};
  Frame frame = frame_of(96, 80, {clouds});
  frame.tolerance = 0.01;
  const ReferenceImage exact = reference::render(frame);
  EXPECT_LE(largest_error(draw(frame, 3), exact), 0.3 * frame.tolerance);
}

// Unless they are asked for.
TEST_P(Slabs, AreForProcessors) {
  const Frame frame = clouds_of_column(0.02);
  PlanOptions options;
  options.slabs = 2;
  Renderer renderer({"", GetParam()});
  renderer.render(frame, make_plan(frame, options));
  EXPECT_EQ(renderer.stats().check.worst.slabs > 0, GetParam() == CompositeShape::rows);
}

TEST_P(Slabs, AreNotDrawnForSmallTolerances) {
  Frame frame = clouds_of_column(0.02);
  for (const double small : {1e-4, 1e-5, 0.0}) {
    frame.tolerance = small;
    draw(frame, 4);
    EXPECT_EQ(check().worst.slabs, 0) << small;
  }
}

}  // namespace
}  // namespace splotchcl::test
