#pragma once

#include "finish/layout.h"
#include "finish/text_style.h"
#include "splotchcl/frame.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A bar as long as its length at the look-at point appears, with the length above it.
// Pictures of wide angles have no such scale. Throws UsageError for lengths that do not fit.
Overlay make_scale_bar(const ScaleBarSettings& settings, const Frame& frame,
                       const SnapshotInfo& snapshot, const TextStyle& style, Layout& layout);

}  // namespace splotchcl
