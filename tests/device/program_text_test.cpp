// Programs that declare the language's functions themselves (kernels/common/builtins.h).
#include "device/opencl/program_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "device/opencl/launch.h"
#include "device/opencl/program_build.h"
#include "device/stages.h"

namespace splotchcl::test {
namespace {

std::vector<ProgramSource> programs_of(const Specialization& variant) {
  std::vector<ProgramSource> programs = {variant.bin(), variant.composite(), variant.list_around(),
                                         variant.behind(), variant.resolve()};
  for (const ProjectOutput output :
       {ProjectOutput::counts, ProjectOutput::splats, ProjectOutput::splats_and_keys,
        ProjectOutput::key_counts, ProjectOutput::window_counts, ProjectOutput::window_splats})
    programs.push_back(variant.project(output));
  if (variant.is_extended()) return programs;
  if (variant.is_ordered()) programs.push_back(variant.composite_with_clouds());
  for (const ProgramSource& program :
       {variant.join(), variant.composite_slab(), variant.join_slab(), variant.certify(),
        variant.coarse_grids(), variant.blur(), variant.lay_slab()})
    programs.push_back(program);
  return programs;
}

std::vector<ProgramSource> programs_of_all_frames() {
  return {Specialization::interpolate(true),
          Specialization::interpolate(false),
          Specialization::boxes(true, true),
          Specialization::boxes(false, false),
          Specialization::scan_blocks(),
          Specialization::compact(),
          Specialization::sort(),
          Specialization::sort_groups(),
          Specialization::carry(),
          Specialization::scan(),
          Specialization::clear(),
          Specialization::add_light()};
}

class ProgramTexts : public StageTest {
 protected:
  static bool zeroes_denormals(const ProgramSource& source) {
    const std::string options = text_of(source, device().device).options;
    return options.find("-cl-denorms-are-zero") != std::string::npos;
  }
};

// Elsewhere a column or a width may be as small.
TEST_F(ProgramTexts, LetLayersOfSinglePrecisionAloneTakeDenormalNumbersAsZero) {
  DrawnComponent gray = component_of({{0, 0, 10, 2, 1}}, two_colors());
  gray.absorption = {Absorption::Kind::gray, 1};
  Frame frame = frame_of(16, 16, {gray});
  for (const double tolerance : {1e-3, 0.0}) {
    frame.tolerance = tolerance;
    const FramePlan plan = make_plan(frame);
    const Specialization variant(frame, plan, DeviceTraits());
    EXPECT_EQ(zeroes_denormals(variant.composite()), !plan.is_extended()) << tolerance;
    EXPECT_FALSE(zeroes_denormals(variant.bin()));
  }
}

class ShortTexts : public StageTest {
 protected:
  static void expect_compiled(const std::vector<ProgramSource>& programs) {
    for (const ProgramSource& program : programs) {
      SCOPED_TRACE(program.defines + program.file);
      // Optimizing takes most of the time, and warns of nothing that is looked for.
      ProgramText text = short_text_of(program, device().device);
      text.options += " -cl-opt-disable";
      EXPECT_NO_THROW(expect_no_warnings(build_program(device().context, text, program.file)));
    }
  }
  // What PoCL has compiled before comes from its cache, without what it said of it.
  static void expect_no_warnings(const compute::program& program) {
    EXPECT_THAT(program.build_log(), testing::Not(testing::HasSubstr("warning:")));
  }
  static std::vector<Frame> frames() {
    const Absorption none{Absorption::Kind::none, 0}, gray{Absorption::Kind::gray, 1};
    return {small_frame(none, 1e-3, Projection::perspective),
            small_frame(gray, 1e-5, Projection::perspective),
            small_frame(gray, 0, Projection::perspective),
            small_frame(gray, 1e-3, Projection::fisheye)};
  }
  static Frame small_frame(const Absorption& absorption, double tolerance, Projection projection) {
    Frame frame = frame_of(32, 16, {component_of({{0, 0, 1, 1, 1}}, two_colors())});
    frame.components.front().absorption = absorption;
    frame.tolerance = tolerance;
    frame.projection = projection;
    frame.through_clouds = true;
    return frame;
  }
};

TEST_F(ShortTexts, DeclareAllThatKernelsCallAndCompileWithoutWarnings) {
  if (!is_pocl(device().device)) GTEST_SKIP() << "other compilers get the whole text";
  expect_compiled(programs_of_all_frames());
  std::set<std::string> compiled;
  for (const bool rows : {true, false}) {
    DeviceTraits traits = device().traits;
    choose_shape(traits, rows);
    for (const Frame& frame : frames()) {
      const FramePlan plan = make_plan(frame);
      std::vector<ProgramSource> programs;
      for (const ProgramSource& program : programs_of(Specialization(frame, plan, traits))) {
        if (compiled.insert(text_of(program, device().device).source).second)
          programs.push_back(program);
      }
      expect_compiled(programs);
    }
  }
}

TEST_F(ShortTexts, ThatDoNotCompileAreReplacedByWholeOnes) {
  ProgramSource source;
  source.more = "__kernel void root(__global float* x) { *x = cbrt(27.0f); }";
  const auto result = device().pool.get<float>(1, "root");
  Launch(device(), "test", device().programs.get(source).create_kernel("root"))
      .arg(result)
      .run_items(1);
  EXPECT_FLOAT_EQ(device().pool.download(result, 1).front(), 3);
}

}  // namespace
}  // namespace splotchcl::test
