#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace splotchcl {

// A tile of ranks from 0 to 4095, each once, that repeats without a seam: those within any range
// lie evenly, without clusters and holes. Made by the void-and-cluster method, which a test repeats
// (tests/image/void_and_cluster.h).
inline constexpr std::size_t blue_noise_side = 64;
extern const std::array<std::uint16_t, blue_noise_side * blue_noise_side> blue_noise_ranks;

}  // namespace splotchcl
