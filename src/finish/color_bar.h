#pragma once

#include <vector>

#include "finish/layout.h"
#include "finish/text_style.h"
#include "splotchcl/frame.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The components that have a bar, as indices. Throws UsageError for names that no component
// has, components that no field colours, and a number of labels that is another.
std::vector<std::size_t> components_with_bars(const Scene& scene);

// A bar for each: the palette's own colours as light, with the values that they stand for.
std::vector<Overlay> make_color_bars(const Scene& scene, const Frame& frame,
                                     const SnapshotInfo& snapshot, const TextStyle& style,
                                     Layout& layout);

}  // namespace splotchcl
