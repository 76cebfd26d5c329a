// Writes the text of each program that a GPU draws the four headline plans with, for compilers that
// need no GPU (scripts/check_gpu_pipes).
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "device/frame/variant.h"
#include "device/opencl/device_traits.h"
#include "device/opencl/program_text.h"
#include "device/stages/stage_programs.h"
#include "splotchcl/error.h"
#include "synthetic.h"

namespace splotchcl::bench {
namespace {

const std::vector<std::string> options = {"into=FOLDER: where the texts go", "help: shows this"};

Frame headline_frame(LightPlan light, bool original_kernel) {
  UniverseSetup setup;
  setup.particles = 1000;
  Frame frame = universe_frame(make_universe(setup), 1400, 1050);
  set_light(frame, light);
  if (original_kernel) {
    frame.kernel.width = 0.41314;
    frame.kernel.cut = 1.8153652;
    frame.kernel.sampling = Sampling::center;
  }
  return frame;
}

Variant gpu_variant(const Frame& frame) {
  DeviceTraits traits;
  traits.choose_shape(false);
  traits.native_exp2 = true;
  PlanOptions without_slabs;  // as GPUs draw
  without_slabs.slabs = 0;
  return Variant(frame, make_plan(frame, without_slabs), traits);
}

using NamedProgram = std::pair<const char*, ProgramSource>;

std::vector<NamedProgram> programs_of(const Variant& variant) {
  std::vector<NamedProgram> programs = {
      {"project", project_program(variant, ProjectOutput::splats_and_keys)},
      {"bin", bin_program(variant)},
      {"composite", composite_program(variant)},
      {"certify", certify_program(variant)},
      {"resolve", resolve_program(variant)},
      {"scan", program_source("kernels/scan/scan_groups.cl")},
      {"sort", program_source("kernels/sort/sort_groups.cl")}};
  if (!variant.is_ordered()) programs.emplace_back("refine", refine_program(variant));
  return programs;
}

std::string text_of(const ProgramSource& source) {
  const std::string text = flattened("#include \"" + source.file + "\"\n");
  return source.defines + mentioned(source.variant, text) + text;
}

void write_texts(const Arguments& arguments) {
  const std::filesystem::path folder = arguments.text("into", "");
  if (folder.empty()) throw UsageError("--into is missing: name a folder for the texts");
  std::filesystem::create_directories(folder);
  for (const LightPlan light : {LightPlan::proportional, LightPlan::ordered}) {
    for (const bool original : {false, true}) {
      const std::string plan = std::string(light == LightPlan::ordered ? "ordered" : "sums") +
                               (original ? "_original" : "_native");
      for (const auto& [stage, source] : programs_of(gpu_variant(headline_frame(light, original))))
        std::ofstream(folder / (plan + "_" + stage + ".cl")) << text_of(source);
    }
  }
}

}  // namespace
}  // namespace splotchcl::bench

int main(int count, char** words) {
  using namespace splotchcl::bench;
  return run_main(count, words, options, write_texts);
}
