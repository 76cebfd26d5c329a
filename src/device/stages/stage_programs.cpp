#include "device/stages/stage_programs.h"

namespace splotchcl {
namespace {

// Lists are counted with sums alone, and on processors.
Choices choices_of(ProjectOutput output, bool counts_tiles) {
  return {flag("OUTPUT_SPLATS", output != ProjectOutput::key_counts),
          flag("OUTPUT_KEYS", output == ProjectOutput::splats_and_keys),
          flag("COUNT_KEYS", output == ProjectOutput::key_counts),
          flag("COUNT_TILES", counts_tiles)};
}

// Of one particle at a time.
std::string double_values(const Variant& variant) {
  return flag("DOUBLE_VALUES", variant.extended);
}

Choices composite_choices(const Variant& variant, bool has_clouds) {
  return {flag("ROWS_OF_16", variant.takes_rows_of_16()), flag("CLOUDS_IN_LISTS", has_clouds)};
}

// By rows of a tile, or a pixel for each item of a group.
std::string composite_file(const Variant& variant) {
  const std::string shape = variant.rows ? "rows.cl" : "groups.cl";
  return (variant.extended ? "kernels/composite/composite_extended_"
                           : "kernels/composite/composite_") +
         shape;
}

// Of light in layers, which fades to denormal numbers behind many: no picture shows them.
ProgramSource program_of_layers(const Variant& variant, const std::string& file,
                                const Choices& choices = {}) {
  ProgramSource source = program_source(variant, file, choices);
  source.denormals_are_zero = !variant.extended;
  return source;
}

}  // namespace

ProgramSource project_program(const Variant& variant, ProjectOutput output) {
  Choices choices = choices_of(output, variant.rows && output == ProjectOutput::splats);
  choices.push_back(double_values(variant));
  if (!variant.rows) return program_source(variant, "kernels/project/project_groups.cl", choices);
  if (variant.rows_of_16 && !variant.extended) choices.emplace_back("LANES_16");
  return program_source(variant, "kernels/project/project.cl", choices);
}

ProgramSource bin_program(const Variant& variant) {
  return program_source(variant, variant.rows ? "kernels/bin/bin.cl" : "kernels/bin/bin_groups.cl");
}

ProgramSource composite_program(const Variant& variant) {
  return program_of_layers(variant, composite_file(variant), composite_choices(variant, false));
}

ProgramSource composite_with_clouds_program(const Variant& variant) {
  return program_of_layers(variant, composite_file(variant), composite_choices(variant, true));
}

ProgramSource join_program(const Variant& variant) {
  return program_of_layers(
      variant, variant.rows ? "kernels/composite/join.cl" : "kernels/composite/join_groups.cl",
      {double_values(variant)});
}

ProgramSource add_light_program(const Variant& variant) {
  return program_source(variant, "kernels/composite/add_light.cl", {double_values(variant)});
}

ProgramSource certify_program(const Variant& variant) {
  return program_source(
      variant, variant.rows ? "kernels/certify/collect.cl" : "kernels/certify/collect_groups.cl");
}

ProgramSource refine_program(const Variant& variant) {
  return program_source(variant, "kernels/resolve/refine.cl");
}

ProgramSource blur_program(const Variant& variant) {
  if (!variant.rows) return program_source("kernels/resolve/blur.cl");
  return program_source(variant, "kernels/resolve/blur_strips.cl",
                        variant.rows_of_16 ? Choices{"LANES_16"} : Choices{});
}

ProgramSource lay_slab_program(const Variant& variant) {
  return program_source(variant, "kernels/resolve/slab.cl");
}

ProgramSource resolve_program(const Variant& variant) {
  return program_source(variant, "kernels/resolve/resolve.cl");
}

ProgramSource deepest_program(const Variant& variant) {
  return program_source(variant, "kernels/resolve/deepest.cl");
}

ProgramSource list_around_program(const Variant& variant) {
  return program_source(variant, "kernels/project/list_around.cl", {double_values(variant)});
}

ProgramSource behind_program(const Variant& variant) {
  return program_source(variant, "kernels/composite/behind.cl", {double_values(variant)});
}

}  // namespace splotchcl
