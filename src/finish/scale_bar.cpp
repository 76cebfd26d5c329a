#include "finish/scale_bar.h"

#include <algorithm>
#include <cmath>

#include "finish/labels.h"
#include "finish/ticks.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double part_of_width = 0.2;  // of a length that is chosen, at most

std::string label_of(double length, const ScaleBarSettings& settings, const SnapshotInfo& snapshot,
                     const TextStyle& style) {
  const std::string unit = settings.unit.empty() ? length_unit(snapshot) : settings.unit;
  const std::string number = number_label(length, style.has_superscripts());
  return unit.empty() ? number : number + " " + readable_unit(unit, style.has_superscripts());
}

}  // namespace

Overlay make_scale_bar(const ScaleBarSettings& settings, const Frame& frame,
                       const SnapshotInfo& snapshot, const TextStyle& style, Layout& layout) {
  const double scale = frame.camera.pixels_per_length;
  const double length = settings.length.value_or(round_below(part_of_width * frame.width / scale));
  const double bar_width = length * scale;
  const ShadedText label = style.draw(label_of(length, settings, snapshot, style), style.size());
  const double label_width = label.letters.box_width, label_height = label.letters.box_height;
  const double cap = std::round(0.5 * style.size()), gap = std::round(0.45 * style.size());
  const double width = std::max(bar_width, label_width);
  const Box box = layout.place(settings.at, width, label_height + gap + cap, "finish.scale_bar");

  const double left = is_at_left(settings.at)    ? box.left
                      : is_at_right(settings.at) ? box.right - bar_width
                                                 : box.left + (width - bar_width) / 2;
  const double label_left =
      std::clamp(left + (bar_width - label_width) / 2, box.left, box.right - label_width);
  const double line = style.line(), top = std::round(box.bottom - (cap + line) / 2);
  return [=](Canvas& canvas) {
    style.put(canvas, Box{left, top, left + bar_width, top + line});
    style.put(canvas, Box{left, box.bottom - cap, left + line, box.bottom});
    style.put(canvas, Box{left + bar_width - line, box.bottom - cap, left + bar_width, box.bottom});
    style.put(canvas, label, label_left, box.top);
  };
}

}  // namespace splotchcl
