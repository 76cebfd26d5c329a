#include "finish/bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/words.h"
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

namespace {

// Of the text before a unit as many characters as asked for, and dots for the rest.
std::string shortened(const std::string& title, std::size_t characters) {
  const std::size_t unit = std::min(title.rfind(" ["), title.size());
  std::size_t end = std::min(characters, unit);
  constexpr unsigned char continues = 0x80, mask = 0xc0;  // of UTF-8
  while (end > 0 && (static_cast<unsigned char>(title[end]) & mask) == continues)
    --end;
  return title.substr(0, end) + "..." + title.substr(unit);
}

// Formulas may be longer than a small picture: their letters become smaller, and their end dots.
ShadedText fitting_title(const std::string& title, const TextStyle& style, double size,
                         double room) {
  constexpr double smallest = 0.8;
  ShadedText text = style.draw(title, size);
  const double ratio = room / std::max(1, text.letters.box_width);
  if (ratio >= 1) return text;
  const double smaller = size * std::max(smallest, ratio);
  text = style.draw(title, smaller);
  for (std::size_t left = title.size(); left > 1 && text.letters.box_width > room; --left)
    text = style.draw(shortened(title, left - 1), smaller);
  return text;
}

// One bar with all that is written beside it, before it has a position. Along the bar are
// pixels from its low end; across, pixels from its side without numbers.
class ColorBar {
 public:
  // `room`: for the title along the bar.
  ColorBar(const ColorBarContent& content, double length, double room, bool upright,
           const TextStyle& style)
      : palette_(content.palette), length_(std::round(length)), upright_(upright), style_(style) {
    const double size = style.size();
    thickness_ = std::round(0.85 * size);
    tick_ = std::round(0.3 * size);
    const int most = static_cast<int>(length_ / ((upright ? 1.7 : 3.5) * size));
    for (const Tick& tick : content.ticks(most, style.has_superscripts())) {
      marks_.push_back({tick.position,
                        tick.label.empty() ? ShadedText{} : style.draw(tick.label, number_size())});
      widest_ = std::max(widest_, marks_.back().label.letters.box_width);
      highest_ = std::max(highest_, marks_.back().label.letters.box_height);
    }
    title_ = fitting_title(content.title, style, number_size(), room);
    if (upright) title_ = turned(title_);
  }

  double width() const {
    return upright_ ? numbers_from() + widest_ + gap() + title_.letters.box_width
                    : std::max<double>(length_, title_.letters.box_width);
  }
  double height() const {
    return upright_ ? std::max<double>(length_, title_.letters.box_height)
                    : title_.letters.box_height + gap() + numbers_from() + highest_;
  }

  void put(Canvas& canvas, double left, double top) const {
    if (upright_) {
      put_upright(canvas, left, top + std::round((height() - length_) / 2));
    } else {
      put_flat(canvas, left + std::round((width() - length_) / 2),
               top + title_.letters.box_height + gap());
    }
  }

 private:
  struct Mark {
    double position;
    ShadedText label;
  };

  double number_size() const { return 0.85 * style_.size(); }
  double gap() const { return std::round(0.5 * style_.size()); }
  double numbers_from() const { return thickness_ + tick_ + std::round(0.25 * style_.size()); }
  double tick_length(const Mark& mark) const {
    return mark.label.letters.width > 0 ? tick_ : std::round(0.5 * tick_);
  }

  // The colour of the bar's pixel i, that of the value at its centre.
  Light light_at(int i) const {
    const std::array<double, 3> color = sample_knots(palette_, (i + 0.5) / length_);
    return {static_cast<float>(color[0]), static_cast<float>(color[1]),
            static_cast<float>(color[2])};
  }

  void put_upright(Canvas& canvas, double left, double top) const {
    const double line = style_.line(), bottom = top + length_;
    style_.put(canvas, Box{left - line, top - line, left + thickness_ + line, bottom + line});
    for (int i = 0; i < static_cast<int>(length_); ++i)
      canvas.fill({left, bottom - i - 1, left + thickness_, bottom - i}, light_at(i));
    for (const Mark& mark : marks_) {
      const double y = bottom - mark.position * length_;
      const double above = std::round(y - line / 2);
      style_.put(canvas, Box{left + thickness_ + line, above,
                             left + thickness_ + line + tick_length(mark), above + line});
      style_.put(canvas, mark.label, left + numbers_from(),
                 y - mark.label.letters.box_height / 2.0);
    }
    style_.put(canvas, title_, left + numbers_from() + widest_ + gap(),
               top + (length_ - title_.letters.box_height) / 2);
  }

  void put_flat(Canvas& canvas, double left, double top) const {
    const double line = style_.line(), bottom = top + thickness_;
    style_.put(canvas, Box{left - line, top - line, left + length_ + line, bottom + line});
    for (int i = 0; i < static_cast<int>(length_); ++i)
      canvas.fill({left + i, top, left + i + 1, bottom}, light_at(i));
    for (const Mark& mark : marks_) {
      const double x = left + mark.position * length_;
      const double before = std::round(x - line / 2);
      style_.put(canvas,
                 Box{before, bottom + line, before + line, bottom + line + tick_length(mark)});
      style_.put(canvas, mark.label, x - mark.label.letters.box_width / 2.0, top + numbers_from());
    }
    style_.put(canvas, title_, left + (length_ - title_.letters.box_width) / 2,
               top - gap() - title_.letters.box_height);
  }

  std::vector<Rgb> palette_;
  double length_, thickness_ = 0, tick_ = 0;
  bool upright_;
  TextStyle style_;
  std::vector<Mark> marks_;
  int widest_ = 0, highest_ = 0;
  ShadedText title_;
};

std::size_t component_named(const std::string& name, const Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (scene.components[i].name == name) return i;
    names.push_back(scene.components[i].name);
  }
  throw UsageError(
      fmt::format("key finish.color_bar.components: found \"{}\", expected names of "
                  "components, which are \"{}\"{}",
                  name, fmt::join(names, "\", \""), did_you_mean(nearest_name(name, names))));
}

// What a bar of sums of light stands for is said before the unit.
std::string of_particles(const std::string& label) {
  const std::size_t end = std::min(label.find(" ["), label.size());
  return label.substr(0, end) + " of particles" + label.substr(end);
}

std::string title_of(const Scene& scene, const std::vector<std::size_t>& bars, std::size_t bar,
                     bool keeps_its_palette, const SnapshotInfo& snapshot, bool superscripts) {
  const std::vector<std::string>& labels = scene.finish.color_bar.labels;
  if (!labels.empty()) return labels[bar];
  const Component& component = scene.components[bars[bar]];
  int type = component.types.front();
  for (const int other : component.types) {
    if (snapshot.find_type(type) == nullptr) type = other;
  }
  std::string label = field_label(component.color.field, type, snapshot, superscripts);
  if (!keeps_its_palette) label = of_particles(label);
  const bool needs_name = bars.size() > 1 && !component.name.empty();
  return needs_name ? component.name + ": " + label : label;
}

bool is_white(const std::vector<Rgb>& knots) {
  return !knots.empty() && std::all_of(knots.begin(), knots.end(), [](const Rgb& knot) {
    return knot == Rgb{1, 1, 1};
  });
}

}  // namespace

// Opaque matter shows brightness * palette / (factor * absorption palette).
bool keeps_palette(const DrawnComponent& component, const FinishSettings& finish) {
  const bool is_unchanged = finish.exposure == 0 && finish.tone == ToneCurve::linear &&
                            finish.white == 1 && finish.saturation == 1 && finish.contrast == 1;
  return is_unchanged && component.particles.color_vector.is_absent() &&
         component.absorption.kind == Absorption::Kind::factor &&
         component.absorption.factor == component.brightness &&
         is_white(component.palette.absorption);
}

std::vector<std::string> tell_color_bars(const Scene& scene, const Frame& frame) {
  if (!scene.finish.color_bar.show) return {};
  for (const std::size_t bar : components_with_bars(scene)) {
    const DrawnComponent& component = frame.components[bar];
    if (keeps_palette(component, scene.finish)) continue;
    return {fmt::format(
        "finish.color_bar: light adds up in this picture, so its colors need not be those of the "
        "bar, which shows what single particles of component {} have; splotchcl map draws pictures "
        "whose colors are the bar's",
        component.name)};
  }
  return {};
}

std::vector<std::size_t> components_with_bars(const Scene& scene) {
  const ColorBarSettings& settings = scene.finish.color_bar;
  std::vector<std::size_t> bars;
  for (const std::string& name : settings.components) {
    bars.push_back(component_named(name, scene));
    if (scene.components[bars.back()].color.field.empty()) {
      throw UsageError(
          fmt::format("key finish.color_bar.components: found \"{}\", expected "
                      "components that have a color.field",
                      name));
    }
  }
  for (std::size_t i = 0; settings.components.empty() && i < scene.components.size(); ++i) {
    if (!scene.components[i].color.field.empty()) bars.push_back(i);
  }
  if (bars.empty()) {
    throw UsageError(
        "key finish.color_bar.show: found true, but no component has a color.field, expected one "
        "at least");
  }
  if (!settings.labels.empty() && settings.labels.size() != bars.size()) {
    throw UsageError(fmt::format(
        "key finish.color_bar.labels: found {} labels, expected one for each of {} bars",
        settings.labels.size(), bars.size()));
  }
  return bars;
}

std::vector<ColorBarContent> color_bars_of(const Scene& scene, const Frame& frame,
                                           const SnapshotInfo& snapshot, bool superscripts) {
  const std::vector<std::size_t> shown = components_with_bars(scene);
  std::vector<ColorBarContent> contents;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const DrawnComponent& component = frame.components[shown[i]];
    contents.push_back(
        {component.palette.emission,
         title_of(scene, shown, i, keeps_palette(component, scene.finish), snapshot, superscripts),
         [color = component.color](int most, bool raised) {
           return ticks_of(color, most, raised);
         }});
  }
  return contents;
}

std::vector<Overlay> make_color_bars(const std::vector<ColorBarContent>& contents,
                                     const ColorBarSettings& settings, const Frame& frame,
                                     const TextStyle& style, Layout& layout) {
  const bool upright = settings.at != Anchor::top && settings.at != Anchor::bottom;
  const double side = upright ? frame.height : frame.width;
  const double gap = std::round((upright ? 1.5 : 3) * style.size());
  const auto count = static_cast<double>(contents.size());
  const double length = (settings.length * side - gap * (count - 1)) / count;
  if (length < 4 * style.size()) {
    throw UsageError(fmt::format(
        "key finish.color_bar.length: found {}, which leaves {:.0f} pixels for each of {} bars, "
        "expected more; make it larger or finish.text_size smaller",
        settings.length, std::max(0.0, length), contents.size()));
  }
  constexpr double part_of_side = 0.9;
  const double room = std::max(length, (part_of_side * side - gap * (count - 1)) / count);
  std::vector<ColorBar> bars;
  double width = 0, height = 0;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    bars.emplace_back(contents[i], length, room, upright, style);
    const double between = i > 0 ? gap : 0;
    width = upright ? std::max(width, bars[i].width()) : width + bars[i].width() + between;
    height = upright ? height + bars[i].height() + between : std::max(height, bars[i].height());
  }
  const Box box = layout.place(settings.at, width, height, "finish.color_bar");
  std::vector<Overlay> overlays;
  double left = box.left, top = box.top;
  for (const ColorBar& bar : bars) {
    overlays.emplace_back([bar, left, top](Canvas& canvas) { bar.put(canvas, left, top); });
    (upright ? top : left) += gap + (upright ? bar.height() : bar.width());
  }
  return overlays;
}

}  // namespace splotchcl
