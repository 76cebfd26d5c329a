#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace splotchcl {

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
