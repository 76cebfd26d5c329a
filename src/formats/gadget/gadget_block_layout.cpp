#include "formats/gadget/gadget_block_layout.h"

#include <algorithm>
#include <array>

namespace splotchcl {
namespace {

enum class Carriers { all, gas, stars, gas_and_stars, without_table_mass };

struct StandardBlock {
  std::string_view label;
  Carriers carriers;
  int values_per_particle;
  bool is_integer;
  bool must_fit;  // else the label may mean something else in another code
};

constexpr std::array<StandardBlock, 20> standard_blocks = {{
    {"POS", Carriers::all, 3, false, true},
    {"VEL", Carriers::all, 3, false, true},
    {"ID", Carriers::all, 1, true, true},
    {"MASS", Carriers::without_table_mass, 1, false, true},
    {"MASS", Carriers::all, 1, false, true},
    {"U", Carriers::gas, 1, false, true},
    {"RHO", Carriers::gas, 1, false, true},
    {"HSML", Carriers::gas, 1, false, true},
    {"HSML", Carriers::all, 1, false, true},
    {"HSMS", Carriers::stars, 1, false, false},
    {"AGE", Carriers::stars, 1, false, false},
    {"NE", Carriers::gas, 1, false, false},
    {"NH", Carriers::gas, 1, false, false},
    {"SFR", Carriers::gas, 1, false, false},
    {"TEMP", Carriers::gas, 1, false, false},
    {"Z", Carriers::gas_and_stars, 1, false, false},
    {"BFLD", Carriers::gas, 3, false, false},
    {"POT", Carriers::all, 1, false, false},
    {"ACCE", Carriers::all, 3, false, false},
    {"TSTP", Carriers::all, 1, false, false},
}};

constexpr TypeSet gas = 1U << 0;
constexpr TypeSet stars = 1U << 4;

ValueKind kind_of(bool is_integer, bool is_wide) {
  if (is_integer) return is_wide ? ValueKind::uint64 : ValueKind::uint32;
  return is_wide ? ValueKind::float64 : ValueKind::float32;
}

bool same_layout(const BlockLayout& a, const BlockLayout& b) {
  return a.types == b.types && a.values_per_particle == b.values_per_particle && a.kind == b.kind;
}

}  // namespace

bool is_standard_block(std::string_view label) {
  return std::any_of(
      standard_blocks.begin(), standard_blocks.end(),
      [label](const StandardBlock& block) { return block.label == label && block.must_fit; });
}

BlockLayouts::BlockLayouts(const GadgetHeader& header, std::uint64_t position_bytes,
                           std::vector<BlockDescription> descriptions)
    : counts_(header.counts), descriptions_(std::move(descriptions)) {
  for (std::size_t type = 0; type < counts_.size(); ++type) {
    if (counts_[type] == 0) continue;
    present_ |= 1U << type;
    if (header.table_masses[type] == 0) without_table_mass_ |= 1U << type;
  }
  is_double_ = position_bytes == particles_in(present_) * 3 * sizeof(double);
}

std::uint64_t BlockLayouts::particles_in(TypeSet types) const {
  std::uint64_t particles = 0;
  for (std::size_t type = 0; type < counts_.size(); ++type) {
    if ((types >> type & 1U) != 0) particles += counts_[type];
  }
  return particles;
}

std::optional<BlockLayout> BlockLayouts::fit(std::uint64_t bytes, TypeSet types, int values,
                                             bool is_integer) const {
  types &= present_;
  const std::uint64_t numbers = particles_in(types) * static_cast<std::uint64_t>(values);
  if (numbers == 0) return std::nullopt;
  for (const bool is_wide : {false, true}) {
    const BlockLayout layout = {types, values, kind_of(is_integer, is_wide)};
    if (bytes == numbers * size_of(layout.kind)) return layout;
  }
  if (is_integer && bytes == numbers * size_of(ValueKind::uint48)) {
    return BlockLayout{types, values, ValueKind::uint48};
  }
  return std::nullopt;
}

std::optional<BlockLayout> BlockLayouts::fit_standard(std::string_view label,
                                                      std::uint64_t bytes) const {
  for (const StandardBlock& block : standard_blocks) {
    if (block.label != label) continue;
    TypeSet types = present_;
    if (block.carriers == Carriers::gas) types = gas;
    if (block.carriers == Carriers::stars) types = stars;
    if (block.carriers == Carriers::gas_and_stars) types = gas | stars;
    if (block.carriers == Carriers::without_table_mass) types = without_table_mass_;
    if (const auto layout = fit(bytes, types, block.values_per_particle, block.is_integer)) {
      return layout;
    }
  }
  return std::nullopt;
}

std::optional<BlockLayout> BlockLayouts::fit_description(std::string_view label,
                                                         std::uint64_t bytes) const {
  const auto found = std::find_if(descriptions_.begin(), descriptions_.end(),
                                  [label](const BlockDescription& d) { return d.label == label; });
  if (found == descriptions_.end()) return std::nullopt;
  BlockLayout layout = found->layout;
  layout.types &= present_;
  const std::uint64_t numbers =
      particles_in(layout.types) * static_cast<std::uint64_t>(layout.values_per_particle);
  if (numbers == 0 || bytes != numbers * size_of(layout.kind)) return std::nullopt;
  return layout;
}

std::vector<TypeSet> BlockLayouts::candidate_sets() const {
  std::vector<TypeSet> sets;
  const auto add = [&](TypeSet types) {
    types &= present_;
    if (types != 0 && std::find(sets.begin(), sets.end(), types) == sets.end()) {
      sets.push_back(types);
    }
  };
  // The likely ones first: where counts coincide, the first that fits is taken.
  add(present_);
  add(gas);
  add(stars);
  add(gas | stars);
  for (std::size_t type = 0; type < counts_.size(); ++type)
    add(1U << type);
  for (TypeSet types = 1; types < 1U << counts_.size(); ++types)
    add(types);
  return sets;
}

std::optional<BlockLayout> BlockLayouts::fit_any(std::uint64_t bytes, bool& is_ambiguous) const {
  is_ambiguous = false;
  std::optional<BlockLayout> first;
  for (const bool is_wide : {is_double_, !is_double_}) {
    for (const TypeSet types : candidate_sets()) {
      for (const int values : {1, 3}) {
        const BlockLayout layout = {types, values, kind_of(false, is_wide)};
        const std::uint64_t numbers = particles_in(types) * static_cast<std::uint64_t>(values);
        if (bytes != numbers * size_of(layout.kind)) continue;
        if (first && !same_layout(*first, layout)) is_ambiguous = true;
        if (!first) first = layout;
      }
    }
    if (first) break;  // the other precision is far less likely, so no ambiguity
  }
  return first;
}

}  // namespace splotchcl
