#include "adversary/trial.h"

#include <iomanip>

#include "testing.h"

namespace splotchcl::adversary {
namespace {

template <class Choice, std::size_t count>
using Names = std::array<std::pair<Choice, const char*>, count>;

constexpr Names<Arrangement, 7> arrangements = {{{Arrangement::point, "point"},
                                                 {Arrangement::ring, "ring"},
                                                 {Arrangement::line, "line"},
                                                 {Arrangement::lattice, "lattice"},
                                                 {Arrangement::sheet, "sheet"},
                                                 {Arrangement::corner, "corner"},
                                                 {Arrangement::scatter, "scatter"}}};
constexpr Names<Light, 7> lights = {{{Light::emission, "emission"},
                                     {Light::proportional, "proportional"},
                                     {Light::factor, "factor"},
                                     {Light::ordered, "ordered"},
                                     {Light::gray, "gray"},
                                     {Light::stars_among_gas, "stars_among_gas"},
                                     {Light::two_sources, "two_sources"}}};
constexpr Names<Projection, 5> projections = {{{Projection::perspective, "perspective"},
                                               {Projection::orthographic, "orthographic"},
                                               {Projection::fisheye, "fisheye"},
                                               {Projection::equirectangular, "equirectangular"},
                                               {Projection::cube, "cube"}}};
constexpr Names<MapKind, 5> maps = {{{MapKind::none, "none"},
                                     {MapKind::column, "column"},
                                     {MapKind::mean, "mean"},
                                     {MapKind::dispersion, "dispersion"},
                                     {MapKind::integral, "integral"}}};
constexpr Names<Sampling, 2> samplings = {{{Sampling::mean, "mean"}, {Sampling::center, "center"}}};
constexpr Names<ToneCurve, 3> tones = {
    {{ToneCurve::linear, "linear"}, {ToneCurve::asinh, "asinh"}, {ToneCurve::filmic, "filmic"}}};
constexpr Names<CompositeShape, 2> shapes = {
    {{CompositeShape::rows, "rows"}, {CompositeShape::groups, "groups"}}};

template <class Choice, std::size_t count>
const char* name_in(const Names<Choice, count>& names, Choice choice) {
  for (const auto& [value, name] : names) {
    if (value == choice) return name;
  }
  return "";
}

template <class Choice, std::size_t count>
bool take_choice(const Names<Choice, count>& names, const std::string& word, Choice& choice) {
  for (const auto& [value, name] : names) {
    if (word != name) continue;
    choice = value;
    return true;
  }
  return false;
}

template <class Owner>
void print_numbers(const Owner& owner, const std::vector<Gene<Owner>>& genes, const char* indent,
                   std::ostream& out) {
  const Owner usual;
  for (const Gene<Owner>& gene : genes) {
    const double value = owner.*gene.member;
    if (value != usual.*gene.member) out << indent << gene.name << " " << value << "\n";
  }
}

template <class Owner>
bool take_number(Owner& owner, const std::vector<Gene<Owner>>& genes, const std::string& key,
                 const std::string& word) {
  for (const Gene<Owner>& gene : genes) {
    if (key != gene.name) continue;
    std::istringstream in(word);
    return static_cast<bool>(in >> owner.*gene.member);
  }
  return false;
}

bool take_choice_of_trial(Trial& trial, const std::string& key, const std::string& word) {
  if (key == "class") return trial.kind = word, true;
  if (key == "light") return take_choice(lights, word, trial.light);
  if (key == "projection") return take_choice(projections, word, trial.projection);
  if (key == "map") return take_choice(maps, word, trial.map);
  if (key == "sampling") return take_choice(samplings, word, trial.sampling);
  if (key == "tone") return take_choice(tones, word, trial.tone);
  if (key == "shape") return take_choice(shapes, word, trial.shape);
  return false;
}

bool take_pair(Trial& trial, const std::string& key, const std::string& word) {
  if (key == "group") {
    trial.groups.emplace_back();
    return take_choice(arrangements, word, trial.groups.back().arrangement);
  }
  if (take_choice_of_trial(trial, key, word) || take_number(trial, trial_genes(), key, word) ||
      take_number(trial.shown, shown_genes(), key, word)) {
    return true;
  }
  return !trial.groups.empty() && take_number(trial.groups.back(), group_genes(), key, word);
}

}  // namespace

const std::vector<Gene<Trial>>& trial_genes() {
  using Scale = Gene<Trial>::Scale;
  static const std::vector<Gene<Trial>> genes = {
      {"tolerance", &Trial::tolerance, Scale::fixed, 0, 0},
      {"width", &Trial::width, Scale::fixed, 0, 0},
      {"height", &Trial::height, Scale::fixed, 0, 0},
      {"picture_size", &Trial::picture_size, Scale::fixed, 0, 0},
      {"crop_x", &Trial::crop_x, Scale::linear, 0, 1},
      {"crop_y", &Trial::crop_y, Scale::linear, 0, 1},
      {"field_of_view", &Trial::field_of_view, Scale::logarithmic, 1, 150},
      {"turned", &Trial::turned, Scale::fixed, 0, 1},
      {"background", &Trial::background, Scale::logarithmic, 1e-3, 1e4},
      {"source", &Trial::source, Scale::logarithmic, 1e-3, 1e3},
      {"star_source", &Trial::star_source, Scale::logarithmic, 1e-3, 1e3},
      {"tint", &Trial::tint, Scale::linear, 0, 1},
      {"knots", &Trial::knots, Scale::whole, 2, 300},
      {"decades", &Trial::decades, Scale::logarithmic, 0.1, 30},
      {"cut", &Trial::cut, Scale::logarithmic, 0.03, 4},
      {"min_radius", &Trial::min_radius, Scale::logarithmic, 0.1, 3},
      {"footprint", &Trial::footprint, Scale::logarithmic, 0.05, 4},
      {"slabs", &Trial::slabs, Scale::whole, 0, 12},
      {"own_colors", &Trial::own_colors, Scale::fixed, 0, 1},
      {"around", &Trial::around, Scale::fixed, 0, 1},
      {"certify", &Trial::certify, Scale::fixed, 0, 1},
      {"dome", &Trial::dome, Scale::fixed, 0, 1},
      {"original", &Trial::original, Scale::fixed, 0, 1},
      {"eye", &Trial::eye, Scale::logarithmic, 1e-4, 3},
      {"left_eye", &Trial::left_eye, Scale::fixed, 0, 1},
      {"inset", &Trial::inset, Scale::logarithmic, 1e-4, 1},
      {"between", &Trial::between, Scale::logarithmic, 0.01, 0.99},
      {"motion", &Trial::motion, Scale::logarithmic, 0.01, 1e4},
      {"box", &Trial::box, Scale::logarithmic, 100, 1e4},
      {"slice", &Trial::slice, Scale::fixed, 0, 1},
      {"signs", &Trial::signs, Scale::fixed, 0, 1},
      {"value_decades", &Trial::value_decades, Scale::logarithmic, 0.1, 60},
      {"map_floor", &Trial::map_floor, Scale::logarithmic, 1e-9, 0.1},
      {"filler", &Trial::filler, Scale::fixed, 0, 0},
      {"period", &Trial::period, Scale::fixed, 0, 0},
      {"offset", &Trial::offset, Scale::fixed, 0, 0},
      {"jitter_seed", &Trial::jitter_seed, Scale::whole, 1, 1000},
  };
  return genes;
}

const std::vector<Gene<CloudGroup>>& group_genes() {
  using Scale = Gene<CloudGroup>::Scale;
  static const std::vector<Gene<CloudGroup>> genes = {
      {"places", &CloudGroup::places, Scale::whole, 1, 200},
      {"copies", &CloudGroup::copies, Scale::whole, 1, 400},
      {"x", &CloudGroup::x, Scale::linear, -120, 120},
      {"y", &CloudGroup::y, Scale::linear, -120, 120},
      {"spread", &CloudGroup::spread, Scale::logarithmic, 0.05, 6},
      {"sigma", &CloudGroup::sigma, Scale::logarithmic, 0.3, 400},
      {"width_range", &CloudGroup::width_range, Scale::logarithmic, 1, 4},
      {"peak", &CloudGroup::peak, Scale::logarithmic, 1e-4, 1e6},
      {"jitter", &CloudGroup::jitter, Scale::logarithmic, 1e-4, 1},
      {"depth", &CloudGroup::depth, Scale::logarithmic, 1, 100},
      {"hue", &CloudGroup::hue, Scale::linear, 0, 1},
      {"color", &CloudGroup::color, Scale::logarithmic, 1e-4, 1e4},
      {"star", &CloudGroup::star, Scale::fixed, 0, 1},
  };
  return genes;
}

const std::vector<Gene<Shown>>& shown_genes() {
  using Scale = Gene<Shown>::Scale;
  static const std::vector<Gene<Shown>> genes = {
      {"shown", &Shown::is_on, Scale::fixed, 0, 1},
      {"automatic", &Shown::automatic, Scale::fixed, 0, 1},
      {"exposure", &Shown::exposure, Scale::linear, -3, 10},
      {"white", &Shown::white, Scale::logarithmic, 0.05, 50},
      {"balance", &Shown::balance, Scale::logarithmic, 1667, 25000},
      {"bloom", &Shown::bloom, Scale::logarithmic, 0.01, 1},
      {"highlights", &Shown::highlights, Scale::logarithmic, 0.01, 1},
      {"saturation", &Shown::saturation, Scale::linear, 0, 2.5},
      {"contrast", &Shown::contrast, Scale::logarithmic, 1, 2.5},
      {"pivot", &Shown::pivot, Scale::logarithmic, 0.2, 1},
  };
  return genes;
}

const char* name(Arrangement arrangement) {
  return name_in(arrangements, arrangement);
}
const char* name(Light light) {
  return name_in(lights, light);
}
const char* name(CompositeShape shape) {
  return name_in(shapes, shape);
}

LightPlan plan_of(Light light) {
  if (light == Light::emission) return LightPlan::emission;
  const bool is_sum = light == Light::proportional || light == Light::factor;
  return is_sum ? LightPlan::proportional : LightPlan::ordered;
}

std::string text_of(const Trial& trial) {
  std::ostringstream out;
  out << std::setprecision(digits);
  out << "class " << trial.kind << "\nlight " << name(trial.light) << "\nprojection "
      << name_in(projections, trial.projection) << "\nmap " << name_in(maps, trial.map)
      << "\nsampling " << name_in(samplings, trial.sampling) << "\nshape " << name(trial.shape)
      << "\n";
  if (trial.shown.is_on > 0) out << "tone " << name_in(tones, trial.tone) << "\n";
  print_numbers(trial, trial_genes(), "", out);
  print_numbers(trial.shown, shown_genes(), "", out);
  for (const CloudGroup& group : trial.groups) {
    out << "group " << name(group.arrangement) << "\n";
    print_numbers(group, group_genes(), "  ", out);
  }
  return out.str();
}

void set(const std::string& text, Trial& trial) {
  std::istringstream words(text);
  for (std::string key, word; words >> key;) {
    if (key == "#") {
      std::getline(words, word);
    } else if (!(words >> word) || !take_pair(trial, key, word)) {
      throw std::runtime_error("trial: found '" + key + " " + word +
                               "', expected the name of a number or a choice, and its value");
    }
  }
}

Trial trial_of(const std::string& text) {
  Trial trial;
  set(text, trial);
  return trial;
}

}  // namespace splotchcl::adversary
