#include <fmt/format.h>

#include <cmath>

#include "par/translate.h"
#include "scene/constants.h"
#include "scene_file/values.h"

namespace splotchcl::par {
namespace {

using scene_file::write_number;
using scene_file::write_text;

// Keys of one component, whose number ends their names.
class ComponentKeys {
 public:
  ComponentKeys(ParFile& par, int number) : par_(par), number_(std::to_string(number)) {}

  std::string name(const std::string& key) const { return key + number_; }
  bool has(const std::string& key) const { return par_.has(name(key)); }
  std::optional<std::string> text(const std::string& key) { return par_.text(name(key)); }
  std::optional<double> number(const std::string& key) { return par_.number(name(key)); }
  bool flag(const std::string& key, bool otherwise) {
    return par_.boolean(name(key)).value_or(otherwise);
  }
  double positive(const std::string& key, double otherwise) {
    const double value = number(key).value_or(otherwise);
    if (!(value > 0)) par_.refuse(name(key), "a number > 0");
    return value;
  }
  // A block of the snapshot; XXXX stands for none.
  std::optional<std::string> block(const std::string& key) {
    const auto label = text(key);
    return label && *label != "XXXX" ? label : std::nullopt;
  }
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const {
    par_.refuse(name(key), expected);
  }
  // Values in a path stand for themselves, without the factor that the file's own have.
  void note_column(const std::string& key, const std::string& factor, Translation& t) const {
    if (t.path_row.count(name(key)) == 0) return;
    t.note(fmt::format("{} is not carried over to the path's column {}", name(factor), name(key)));
  }

 private:
  ParFile& par_;
  std::string number_;
};

// How a field becomes a number from 0 to 1: f(factor * value), clamped to min .. max.
void translate_field(const std::string& from, const std::string& to, ComponentKeys& keys,
                     Translation& t) {
  const auto block = keys.block(from + "_label");
  const bool is_log = keys.flag(from + "_log", true);
  const bool is_asinh = keys.flag(from + "_asinh", false);
  const double factor = keys.positive(from + "_fac", 1);
  const auto minimum = keys.number(from + "_min"), maximum = keys.number(from + "_max");
  if (!block) return;
  if (factor != 1) {
    for (const char* const limit : {"_min", "_max"})
      keys.note_column(from + limit, from + "_fac", t);
  }
  const std::string log = keys.name(from + "_log"), asinh = keys.name(from + "_asinh");
  const bool is_asinh_alone = is_asinh && !keys.has(from + "_log");
  const bool uses_log = is_log && !is_asinh_alone;
  if (uses_log && is_asinh) keys.refuse(from + "_asinh", "F, since " + log + " is T");
  t.scene.set_of_component(to + ".field", write_text(*block));
  t.scene.set_of_component(to + ".scaling", is_asinh   ? "\"asinh\""
                                            : uses_log ? "\"log\""
                                                       : "\"linear\"");
  if (is_asinh && factor != 1) {
    t.note(keys.name(from + "_fac") + " is not carried over beside " + asinh);
  }
  const auto before_scaling = [&](double value) {
    if (is_asinh) return std::sinh(value);
    return (uses_log ? std::pow(10, value) : value) / factor;
  };
  if (minimum) t.scene.set_of_component(to + ".min", write_number(before_scaling(*minimum)));
  if (maximum) t.scene.set_of_component(to + ".max", write_number(before_scaling(*maximum)));
  if (!minimum || !maximum) t.scene.set_of_component(to + ".percentiles", "[0, 100]");
}

void translate_color(ComponentKeys& keys, Translation& t) {
  const bool is_vector = keys.flag("color_is_vector", false);
  const auto palette = keys.text("palette");
  if (is_vector) {
    const auto block = keys.block("color_label");
    if (!block) keys.refuse("color_label", "a block of three values, since color_is_vector is T");
    for (const char* const unused :
         {"color_log", "color_asinh", "color_min", "color_max", "color_fac"})
      keys.text(unused);
    t.scene.set_of_component("color.vector", write_text(*block));
    t.note(keys.name("color_is_vector") +
           ": the three values are taken for red, green and blue "
           "as they are, without a range");
    return;
  }
  translate_field("color", "color", keys, t);
  if (!palette) keys.refuse("palette", "a palette file");
  t.scene.set_of_component("palette", write_text(t.file(*palette).string()));
}

void translate_size(ComponentKeys& keys, Translation& t) {
  const double fixed = keys.number("size_fix").value_or(0);
  const auto block = keys.block("size_label");
  const double factor = keys.positive("size_fac", 1);
  const double smooth_factor = keys.positive("smooth_factor", 1);
  if (smooth_factor != 1) keys.note_column("size_fac", "smooth_factor", t);
  if (fixed < 0) keys.refuse("size_fix", "a number > 0, or 0 to read sizes from the snapshot");
  std::string size = fmt::format("{{ factor = {}", write_number(factor * smooth_factor));
  if (fixed > 0) {
    size += fmt::format(", fixed = {} }}", write_number(fixed));
  } else {
    if (!block) t.note(keys.name("size_label") + " names no block: smoothing lengths are found");
    size += fmt::format(", field = {} }}", write_text(block.value_or("smoothing_length")));
  }
  t.scene.set_of_component("size", size);
  // The column of h is 0.25 pi^(-5/6) / (h size_fac); that of this program 1 / (h size.factor).
  t.scene.set_of_component("weight", "\"constant\"");
  t.scene.set_of_component("reference_column",
                           write_number(4 * std::pow(pi, 5.0 / 6) / smooth_factor));
}

void translate_absorption(ComponentKeys& keys, Translation& t) {
  const bool is_as_emission = t.par.boolean("a_eq_e").value_or(true);
  const auto of_all = t.par.number("gray_absorption");
  const auto own = keys.number("gray_absorption");
  const double gray = own.value_or(of_all.value_or(0.2));
  if (gray < 0)
    t.par.refuse(own ? keys.name("gray_absorption") : "gray_absorption", "a number >= 0");
  if (is_as_emission) {
    t.scene.set_of_component("absorption", "\"emission\"");
  } else {
    t.scene.set_of_component("gray_absorption", write_number(gray));
  }
}

void translate_component(int number, Translation& t) {
  constexpr int largest_type = 31;
  ComponentKeys keys(t.par, number);
  t.scene.begin_component();
  const int type = t.par.integer(keys.name("ptype"), 0, largest_type).value_or(number);
  t.scene.set_of_component("types", std::to_string(type));
  translate_size(keys, t);
  translate_color(keys, t);
  translate_field("intensity", "intensity", keys, t);
  t.scene.set_of_component("brightness", write_number(keys.positive("brightness", 1)));
  translate_absorption(keys, t);
}

int component_count(Translation& t) {
  constexpr int most = 100;
  return t.par.integer("ptypes", 1, most).value_or(1);
}

// The block of numbers that all components name by this key; nothing where they differ.
std::optional<std::string> block_of_all(Translation& t, const std::string& key) {
  const int count = component_count(t);
  const std::optional<std::string> block = ComponentKeys(t.par, 0).block(key);
  for (int number = 0; number < count; ++number) {
    ComponentKeys keys(t.par, number);
    if (keys.block(key) != block) return std::nullopt;
    if (key == "color_label" && keys.flag("color_is_vector", false)) return std::nullopt;
  }
  return block;
}

struct ParOrder {
  const char* key;       // of the components
  const char* in_front;  // what is drawn last lies in front
  const char* what;
};

void translate_order_by(int type, const ParOrder& order, Translation& t) {
  const std::optional<std::string> field = block_of_all(t, order.key);
  if (!field) {
    t.note(
        fmt::format("sort_type {}, {}, is not carried over, as the components have no {}N in "
                    "common: the nearest lies in front",
                    type, order.what, order.key));
    return;
  }
  t.scene.set_text("sort.by", *field);
  t.scene.set_text("sort.order", order.in_front);
  t.note(fmt::format("sort_type: clouds are ordered by the field {} instead of {}", *field,
                     order.what));
}

}  // namespace

void translate_components(Translation& t) {
  const int count = component_count(t);
  for (int number = 0; number < count; ++number)
    translate_component(number, t);
}

// The picture is only then one of order where absorption is not emission.
void translate_order(Translation& t) {
  const int type = t.par.integer("sort_type", 0, 4).value_or(1);
  const bool is_ordered = !t.par.boolean("a_eq_e").value_or(true);
  if (type == 1 || !is_ordered) return;
  const char* const red = "the red of their colour";
  if (type == 2) translate_order_by(type, {"color_label", "ascending", red}, t);
  if (type == 3) translate_order_by(type, {"color_label", "descending", red}, t);
  if (type == 4) {
    translate_order_by(type, {"size_label", "ascending", "their size in the picture"}, t);
  }
  if (type == 0) {
    t.note("sort_type 0, the order of the file, is not carried over: the nearest lies in front");
  }
}

}  // namespace splotchcl::par
