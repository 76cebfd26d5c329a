#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// The canonical name of a field that a file calls `label` (any case, trailing blanks
// allowed), or an empty string when the label is not a known one.
std::string canonical_field_name(std::string_view label);

// What fields of one type are to be called: a name that they have already, else the canonical name,
// or the file's own where there is none or where another field has it: the one that has it already,
// that the file calls so, else the first.
std::vector<std::string> names_of_fields(const std::vector<FieldInfo>& fields);

// Names them so, whatever they were called before.
void name_fields(ParticleTypeInfo& type);

// The field that `name` means: a canonical name, the file's own label or any other label
// of the same quantity, in any case. "smoothing_length" also finds a type's
// star_smoothing_length where it has no other. Null when there is none.
const FieldInfo* find_field(const ParticleTypeInfo& type, std::string_view name);

// The field, of no file, that tells how much of a particle is there, 0 to 1, where some vanish
// or appear between two snapshots.
constexpr const char* fade_field = "fade";

// Whether each particle's mass is known, from a field or the header's table.
bool has_masses(const ParticleTypeInfo& type);

// The type, or a DataError that lists those with particles.
const ParticleTypeInfo& require_type(const SnapshotInfo& info, int type);
// The field as find_field has it, or a DataError that lists those the type has.
const FieldInfo& require_field(const SnapshotInfo& info, int type, std::string_view name);

// " (the note)" of one that says why the field was left out of what the file has; else empty.
std::string why_left_out(const SnapshotInfo& info, std::string_view name);

// The field of ids, or a DataError.
const FieldInfo& require_ids(const SnapshotInfo& info, int type);
// For a field that does not hold one whole number per particle.
[[noreturn]] void refuse_integers(const SnapshotInfo& info, int type, const FieldInfo& field);
// For a field of ids that does not hold whole numbers.
[[noreturn]] void refuse_ids(const SnapshotInfo& info, int type, const FieldInfo& field);

bool equal_ignoring_case(std::string_view a, std::string_view b);

// Gadget's names for its particle types, in the order of their numbers.
constexpr std::array<const char*, 6> particle_type_names = {"gas",   "halo",  "disk",
                                                            "bulge", "stars", "boundary"};
// One more than the highest number of a type, whatever the code.
constexpr int particle_type_limit = 32;

// A word for any type: "gas", or "type_6" for one that has no name.
std::string particle_type_name(int type);

// The type that a word means, in upper or lower case: a name from above, another that people use
// for it (star, dm, dark_matter, ...), or that of a group in a file (PartType1). None where it
// means none.
std::optional<int> find_particle_type(std::string_view word);

}  // namespace splotchcl
