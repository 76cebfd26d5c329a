#include "scene/same_columns.h"

#include <algorithm>

namespace splotchcl {
namespace {

bool is_same(const Column& a, const Column& b) {
  if (a.source() || b.source()) return a.source() == b.source();
  if (a.is_array() || b.is_array()) return a.data() == b.data() && a.size() == b.size();
  return a.is_uniform() == b.is_uniform() && a.uniform_value() == b.uniform_value();
}

}  // namespace

bool have_same_columns(const Particles& known, const Particles& particles) {
  const auto first = known.columns(), second = particles.columns();
  return known.count == particles.count &&
         std::equal(first.begin(), first.end(), second.begin(),
                    [](const Column* a, const Column* b) { return is_same(*a, *b); });
}

}  // namespace splotchcl
