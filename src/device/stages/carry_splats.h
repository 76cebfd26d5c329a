#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"

namespace splotchcl {

// What of the sorted splats is left from place `first` on, in its order, to the first slots of
// `keyed`, with keys of 0.
void carry_splats(const StageContext& context, const SortedSplats& sorted, std::uint32_t first,
                  const KeyedSplats& keyed);

// All 48 bits of those of the splats' keys that are not above `last`.
std::vector<std::uint64_t> sort_keys_up_to(const StageContext& context, const KeyedSplats& keyed,
                                           std::uint64_t last);

}  // namespace splotchcl
