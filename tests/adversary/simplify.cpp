#include "adversary/simplify.h"

#include <cstdio>

#include "testing.h"

namespace splotchcl::adversary {
namespace {

// Of its error a simpler scene keeps so much, and stays beyond its promise.
constexpr double kept_part = 0.6;

class Simplifier {
 public:
  Simplifier(Finding finding, Judge& judge)
      : best_(std::move(finding)),
        least_(std::max(1.0, kept_part * best_.measurement.ratio())),
        judge_(judge) {}

  Finding run() {
    drop_groups();
    simplify_numbers(trial_genes(), [](Trial& trial) -> Trial& { return trial; });
    simplify_numbers(shown_genes(), [](Trial& trial) -> Shown& { return trial.shown; });
    for (std::size_t i = 0; i < best_.trial.groups.size(); ++i)
      simplify_numbers(group_genes(), [i](Trial& t) -> CloudGroup& { return t.groups[i]; });
    drop_groups();
    return best_;
  }

 private:
  bool take(const Trial& trial) {
    const Measurement measurement = judge_.measure(trial);
    if (measurement.ratio() < least_) return false;
    best_ = {trial, measurement};
    return true;
  }

  void drop_groups() {
    for (std::size_t i = best_.trial.groups.size(); i-- > 0 && best_.trial.groups.size() > 1;) {
      Trial without = best_.trial;
      without.groups.erase(without.groups.begin() + static_cast<std::ptrdiff_t>(i));
      take(without);
    }
  }

  template <class Owner, class Part>
  void simplify_numbers(const std::vector<Gene<Owner>>& genes, const Part& part) {
    const Owner usual;
    for (const Gene<Owner>& gene : genes) {
      if (gene.scale == Gene<Owner>::Scale::fixed) continue;
      const double value = part(best_.trial).*gene.member;
      for (const double simpler : {0.0, usual.*gene.member, rounded(value, 1), rounded(value, 2)}) {
        const bool may_be_off = gene.scale != Gene<Owner>::Scale::whole && usual.*gene.member == 0;
        if (simpler == value || (simpler == 0 && !may_be_off)) continue;
        Trial trial = best_.trial;
        part(trial).*gene.member = simpler;
        if (take(trial)) break;
      }
    }
  }

  static double rounded(double value, int digits_kept) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.*g", digits_kept, value);
    return std::strtod(text, nullptr);
  }

  Finding best_;
  double least_;
  Judge& judge_;
};

}  // namespace

Finding simplified(const Finding& finding, Judge& judge) {
  return Simplifier(finding, judge).run();
}

}  // namespace splotchcl::adversary
