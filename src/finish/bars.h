#pragma once

#include <functional>
#include <string>
#include <vector>

#include "finish/overlay.h"
#include "finish/ticks.h"
#include "splotchcl/frame.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A bar as long as its length at the look-at point appears, with the length above it.
// Pictures of wide angles have no such scale. Throws UsageError for lengths that do not fit.
Overlay make_scale_bar(const ScaleBarSettings& settings, const Frame& frame,
                       const SnapshotInfo& snapshot, const TextStyle& style, Layout& layout);

// The components that have a bar, as indices. Throws UsageError for names that no component
// has, components that no field colours, and a number of labels that is another.
std::vector<std::size_t> components_with_bars(const Scene& scene);

// What one bar shows.
struct ColorBarContent {
  std::vector<Rgb> palette;  // knots, as light
  std::string title;
  // At most about so many with numbers; whether these may have raised digits.
  std::function<std::vector<Tick>(int most, bool superscripts)> ticks;
};

// One for each component that has a bar: the palette's own colours, with the values that they stand
// for.
std::vector<ColorBarContent> color_bars_of(const Scene& scene, const Frame& frame,
                                           const SnapshotInfo& snapshot, bool superscripts);

// Whether a component that hides what is behind it has its palette's colors in the finished
// picture: opaque matter shows emission over absorption, which must be the palette itself, and
// light is not changed afterwards. Where light adds up it is not so.
bool keeps_palette(const DrawnComponent& component, const FinishSettings& finish);

// What the user should know of the scene's color bars: a note, where light adds up; or none.
std::vector<std::string> tell_color_bars(const Scene& scene, const Frame& frame);

// `frame` says how large the picture is. Throws UsageError where the bars have no room.
std::vector<Overlay> make_color_bars(const std::vector<ColorBarContent>& contents,
                                     const ColorBarSettings& settings, const Frame& frame,
                                     const TextStyle& style, Layout& layout);

}  // namespace splotchcl
