#pragma once

#include <cstddef>
#include <cstdint>

namespace splotchcl {

// More columns than any table of particles has: what asks for more is damaged, or no such table.
constexpr std::size_t most_columns = 4096;

// Deflate packs no better than 1032 to 1.
constexpr std::uint64_t best_packing_of_deflate = 1032;

}  // namespace splotchcl
