#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace splotchcl {

// Gadget's names for its particle types, in the order of their numbers.
constexpr std::array<const char*, 6> particle_type_names = {"gas",   "halo",  "disk",
                                                            "bulge", "stars", "boundary"};

// A word for any type: "gas", or "type_6" for one that has no name.
inline std::string particle_type_name(int type) {
  const auto index = static_cast<std::size_t>(type);
  return index < particle_type_names.size() ? particle_type_names[index]
                                            : "type_" + std::to_string(type);
}

}  // namespace splotchcl
