#include "adversary/search.h"

#include <cstdio>

#include "adversary/trial_frame.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

using test::Random;

// Pictures that cost more are not drawn: a search is worth what it draws in its time.
constexpr double largest_cost = 4e6;

constexpr std::size_t most_groups = 5;

double normal(Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
  return radius * std::cos(2 * pi * random.uniform());
}

// As files hold it.
double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

// Back into [0, 1], as from a mirror.
double reflected(double place) {
  place = std::fmod(std::abs(place), 2.0);
  return place > 1 ? 2 - place : place;
}

template <class Owner>
void change(Owner& owner, const Gene<Owner>& gene, double step, Random& random) {
  double& value = owner.*gene.member;
  if (gene.scale == Gene<Owner>::Scale::linear) {
    const double place = (value - gene.low) / (gene.high - gene.low);
    value = gene.low + (gene.high - gene.low) * reflected(place + step * normal(random));
  } else {
    const double range = std::log(gene.high / gene.low);
    const double place = std::log(value / gene.low) / range;
    value = gene.low * std::exp(range * reflected(place + step * normal(random)));
  }
  const bool is_whole = gene.scale == Gene<Owner>::Scale::whole;
  value = rounded(is_whole ? std::round(value) : value);
}

template <class Owner>
void change_some(Owner& owner, const std::vector<Gene<Owner>>& genes, double step, Random& random) {
  constexpr double part = 0.3;
  for (const Gene<Owner>& gene : genes) {
    if (gene.scale == Gene<Owner>::Scale::fixed) continue;
    const bool is_off = gene.scale != Gene<Owner>::Scale::linear && owner.*gene.member == 0;
    if (!is_off && random.uniform() < part) change(owner, gene, step, random);
  }
}

// Another group like one that is there, or one less.
void change_groups(Trial& trial, Random& random) {
  const auto chosen =
      static_cast<std::size_t>(random.uniform(0, static_cast<double>(trial.groups.size())));
  const double choice = random.uniform();
  if (choice < 0.4 && trial.groups.size() < most_groups) {
    CloudGroup another = trial.groups[chosen];
    change_some(another, group_genes(), 0.3, random);
    trial.groups.push_back(another);
  } else if (choice > 0.7 && trial.groups.size() > 1) {
    trial.groups.erase(trial.groups.begin() + static_cast<std::ptrdiff_t>(chosen));
  }
}

// One climb: the parent, and how well its children do.
class Climb {
 public:
  Climb(Judge& judge, Random& random) : judge_(judge), random_(random) {}

  // The best of a few starts.
  void begin(const std::function<Trial(Random&)>& start, const std::function<bool()>& goes_on) {
    constexpr int starts = 6, most_starts = 100;
    step_ = first_step;
    failures_ = 0;
    // The first that does not cost too much counts anyway.
    bool has_begun = false;
    for (int i = 0; i < most_starts && (!has_begun || (i < starts && goes_on())); ++i)
      has_begun |= try_(start(random_), !has_begun);
    if (!has_begun) throw std::runtime_error("all starts of a class cost too much to be drawn");
  }

  void step() {
    constexpr double growth = 1.5, shrinking = 0.92;
    const bool better = try_(changed(parent_.trial, step_, random_), false);
    step_ = std::clamp(step_ * (better ? growth : shrinking), 1e-5, 0.5);
    failures_ = better ? 0 : failures_ + 1;
  }

  bool is_stuck() const { return failures_ > 40; }
  const Finding& parent() const { return parent_; }

 private:
  static constexpr double first_step = 0.1;

  bool try_(const Trial& trial, bool anyway) {
    if (cost(trial) > largest_cost) return false;
    const Measurement measurement = judge_.measure(trial);
    if (!anyway && measurement.ratio() <= parent_.measurement.ratio()) return false;
    parent_ = {trial, measurement};
    return true;
  }

  Judge& judge_;
  Random& random_;
  Finding parent_{{}, {LightPlan::emission, 1}};
  double step_ = first_step;
  int failures_ = 0;
};

}  // namespace

Trial changed(const Trial& trial, double step, Random& random) {
  constexpr double groups_change = 0.1;
  Trial child = trial;
  if (random.uniform() < groups_change) change_groups(child, random);
  // Now and then far away, whatever the step.
  const double size = random.uniform() < 0.1 ? std::max(step, 0.2) : step;
  change_some(child, trial_genes(), size, random);
  if (child.shown.is_on > 0) change_some(child.shown, shown_genes(), size, random);
  for (CloudGroup& group : child.groups)
    change_some(group, group_genes(), size, random);
  return child;
}

Finding search(const std::function<Trial(Random&)>& start, Judge& judge, Random& random,
               const std::function<bool()>& goes_on) {
  Finding best{{}, {LightPlan::emission, 1}};
  Climb climb(judge, random);
  climb.begin(start, goes_on);
  while (goes_on()) {
    climb.step();
    if (climb.parent().measurement.ratio() > best.measurement.ratio()) best = climb.parent();
    if (climb.is_stuck()) climb.begin(start, goes_on);
  }
  if (climb.parent().measurement.ratio() > best.measurement.ratio()) best = climb.parent();
  return best;
}

}  // namespace splotchcl::adversary
