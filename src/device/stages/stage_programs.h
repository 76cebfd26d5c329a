#pragma once

#include "device/frame/variant.h"

// Which file of kernels/ each stage draws a frame with.
namespace splotchcl {

// What a projection writes.
enum class ProjectOutput {
  splats,
  splats_and_keys,  // of those in a window of sort keys (chunks.h)
  key_counts,       // how many of these keys lie in each bin, and no splats
};

ProgramSource project_program(const Variant& variant, ProjectOutput output);
ProgramSource bin_program(const Variant& variant);
ProgramSource composite_program(const Variant& variant);
// The same of lists in which there are clouds around the camera.
ProgramSource composite_with_clouds_program(const Variant& variant);
ProgramSource join_program(const Variant& variant);
// Light of one part of a sum added to that of another.
ProgramSource add_light_program(const Variant& variant);
ProgramSource certify_program(const Variant& variant);
ProgramSource refine_program(const Variant& variant);
ProgramSource blur_program(const Variant& variant);
// A slab's wide splats laid among its narrow ones.
ProgramSource lay_slab_program(const Variant& variant);
ProgramSource resolve_program(const Variant& variant);
// How deep the layers are at most.
ProgramSource deepest_program(const Variant& variant);
// Of clouds around the camera: which they are, and their layers.
ProgramSource list_around_program(const Variant& variant);
ProgramSource behind_program(const Variant& variant);

}  // namespace splotchcl
