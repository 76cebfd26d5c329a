// Programs that declare the language's functions themselves (kernels/common/builtins.h).
#include "device/opencl/program_text.h"

#include "device/opencl/device_traits.h"
#include "device/opencl/launch.h"
#include "device/opencl/program_cache.h"
#include "device/stages.h"
#include "device/stages/stage_programs.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

std::vector<ProgramSource> programs_of(const Variant& variant) {
  std::vector<ProgramSource> programs = {bin_program(variant),         composite_program(variant),
                                         join_program(variant),        deepest_program(variant),
                                         list_around_program(variant), behind_program(variant),
                                         add_light_program(variant),   resolve_program(variant)};
  for (const ProjectOutput output :
       {ProjectOutput::splats, ProjectOutput::splats_and_keys, ProjectOutput::key_counts})
    programs.push_back(project_program(variant, output));
  if (variant.extended) return programs;
  if (variant.is_ordered()) programs.push_back(composite_with_clouds_program(variant));
  for (const ProgramSource& program :
       {composite_program(variant.of_slabs()), join_program(variant.of_slabs()),
        certify_program(variant), refine_program(variant), blur_program(variant),
        lay_slab_program(variant)})
    programs.push_back(program);
  return programs;
}

std::vector<ProgramSource> programs_of_all_frames() {
  return {program_source("kernels/interpolate/interpolate.cl", lanes_of(true)),
          program_source("kernels/interpolate/interpolate.cl", lanes_of(false)),
          program_source("kernels/project/boxes.cl", {"LANES_8", "VECTOR_COLORS 1"}),
          program_source("kernels/project/boxes.cl", {"VECTOR_COLORS 0"}),
          program_source("kernels/project/compact.cl"),
          program_source("kernels/sort/sort.cl"),
          program_source("kernels/sort/sort_groups.cl"),
          program_source("kernels/sort/carry.cl"),
          program_source("kernels/scan/scan_groups.cl"),
          program_source("kernels/common/clear.cl")};
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
    const Variant variant(frame, plan, DeviceTraits());
    EXPECT_EQ(zeroes_denormals(composite_program(variant)), !plan.is_extended()) << tolerance;
    EXPECT_FALSE(zeroes_denormals(bin_program(variant)));
  }
}

class ShortTexts : public StageTest {
 protected:
  static void expect_compiled(const std::vector<ProgramSource>& programs) {
    for (const ProgramSource& program : programs) {
      SCOPED_TRACE(program.defines + program.file);
      // Optimizing takes most of the time, and warns of nothing that is looked for.
      ProgramText text = short_text_of(text_of(program, device().device));
      text.options += " -cl-opt-disable";
      EXPECT_NO_THROW(expect_no_warnings(build_program(device().context, text, program.file)));
    }
  }
  // What PoCL has compiled before comes from its cache, without what it said of it.
  static void expect_no_warnings(const compute::program& program) {
    EXPECT_THAT(program.build_log(), Not(HasSubstr("warning:")));
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
  if (!quirks_of(device().device).reads_declarations)
    GTEST_SKIP() << "other compilers get the whole text";
  expect_compiled(programs_of_all_frames());
  std::set<std::string> compiled;
  for (const bool rows : {true, false}) {
    DeviceTraits traits = device().traits;
    traits.choose_shape(rows);
    for (const Frame& frame : frames()) {
      const FramePlan plan = make_plan(frame);
      std::vector<ProgramSource> programs;
      for (const ProgramSource& program : programs_of(Variant(frame, plan, traits))) {
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
