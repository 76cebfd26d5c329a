#include "formats/gadget/gadget_block_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace splotchcl {
namespace {

// The order of blocks that format 1 agrees on.
std::vector<std::string> standard_order(const GadgetHeader& header, const BlockLayouts& layouts,
                                        bool has_abundances) {
  std::vector<std::string> order = {"POS", "VEL", "ID"};
  // There is none where the mass table has all masses.
  if (layouts.needs_masses()) order.push_back("MASS");
  if (header.counts[0] > 0) {
    order.insert(order.end(), {"U", "RHO"});
    if (has_abundances) order.insert(order.end(), {"NE", "NH"});
    order.push_back("HSML");
    if (has_abundances && header.has_star_formation) order.push_back("SFR");
  }
  if (has_abundances && header.has_stellar_age) order.push_back("AGE");
  if (has_abundances && header.has_metals) order.push_back("Z");
  return order;
}

// A block of a value for each particle, read as `kind`.
StoredValues scalars(const GadgetBinaryFile& file, const GadgetRecord& record, ValueKind kind) {
  StoredValues values;
  values.file = file.file;
  values.offset = record.offset;
  values.particles = record.bytes / size_of(kind);
  values.kind = kind;
  values.is_swapped = file.is_swapped;
  return values;
}

// Whether what could be identifiers is rather a quantity: every value of a sample is an ordinary
// real number, which as an identifier would be far beyond the number of particles.
bool holds_quantities(const GadgetBinaryFile& file, const GadgetRecord& record, ValueKind kind) {
  const bool is_wide = size_of(kind) == 8;
  if (kind == ValueKind::uint48) return false;
  const StoredValues reals =
      scalars(file, record, is_wide ? ValueKind::float64 : ValueKind::float32);
  const StoredValues wholes = scalars(file, record, kind);
  constexpr double beyond_all_particles = 4;
  const auto totals = file.header.full_total_counts();
  const double particles = static_cast<double>(
      std::max(reals.particles, std::accumulate(totals.begin(), totals.end(), std::uint64_t{0})));
  constexpr std::uint64_t sample = 64;
  const std::uint64_t step = std::max<std::uint64_t>(1, reals.particles / sample);
  for (std::uint64_t i = 0; i < reals.particles; i += step) {
    const double size = std::abs(value_at(reals, i, 0));
    const bool is_ordinary = size > 1e-20 && size < 1e20;
    if (!is_ordinary || value_at(wholes, i, 0) < beyond_all_particles * particles) return false;
  }
  return true;
}

bool may_be(const std::string& label, const GadgetBinaryFile& file, const BlockLayouts& layouts,
            const GadgetRecord& record, bool is_short) {
  const auto layout = layouts.fit_standard(label, record.bytes);
  // As many blocks as usual have the usual order: only where some are missing, identifiers may be.
  return layout && !(is_short && label == "ID" && holds_quantities(file, record, layout->kind));
}

// Takes each record for the next block of the order that its length fits.
OrderedBlocks assign_in_order(const GadgetBinaryFile& file, const BlockLayouts& layouts,
                              const std::vector<std::string>& order) {
  const auto blocks = static_cast<std::size_t>(
      std::count_if(file.records.begin(), file.records.end(),
                    [](const GadgetRecord& record) { return record.bytes > 0; }));
  OrderedBlocks result;
  auto next = order.begin();
  for (std::size_t i = 0; i < file.records.size(); ++i) {
    const GadgetRecord& record = file.records[i];
    if (record.bytes == 0) continue;
    const auto found = std::find_if(next, order.end(), [&](const std::string& label) {
      return may_be(label, file, layouts, record, blocks < order.size());
    });
    if (found == order.end()) {
      result.others.push_back(i);
      continue;
    }
    result.skipped.insert(result.skipped.end(), next, found);
    result.standard.push_back({*found, record.offset, *layouts.fit_standard(*found, record.bytes)});
    next = found + 1;
  }
  result.missing.assign(next, order.end());
  return result;
}

bool has_block(const OrderedBlocks& blocks, std::string_view label) {
  return std::any_of(blocks.standard.begin(), blocks.standard.end(),
                     [label](const GadgetBlock& block) { return block.label == label; });
}

std::uint64_t bytes_of(const BlockLayout& layout, const BlockLayouts& layouts) {
  return layouts.particles_in(layout.types) * static_cast<unsigned>(layout.values_per_particle) *
         size_of(layout.kind);
}

}  // namespace

OrderedBlocks order_blocks(const GadgetBinaryFile& file, const BlockLayouts& layouts) {
  const GadgetHeader& header = file.header;
  OrderedBlocks found =
      assign_in_order(file, layouts, standard_order(header, layouts, header.has_cooling));
  if (header.has_cooling && !has_block(found, "HSML")) {
    // Some codes set the flag without writing the abundances.
    found = assign_in_order(file, layouts, standard_order(header, layouts, false));
  }
  return found;
}

std::string describe_order(const OrderedBlocks& blocks, const BlockLayouts& layouts) {
  if (!blocks.skipped.empty()) {
    return fmt::format(
        "format 1 has no labels and {} {} missing: the other blocks were told by their lengths",
        fmt::join(blocks.skipped, ", "), blocks.skipped.size() == 1 ? "is" : "are");
  }
  if (blocks.missing.empty() || blocks.standard.empty()) return {};
  // Where the last block could as well be the next one, another may be missing.
  const std::uint64_t bytes = bytes_of(blocks.standard.back().layout, layouts);
  if (!layouts.fit_standard(blocks.missing.front(), bytes)) return {};
  std::vector<std::string> names;
  for (const GadgetBlock& block : blocks.standard)
    names.push_back(block.label);
  return fmt::format(
      "format 1 has no labels: by the usual order its blocks are {}, and {} {} missing",
      fmt::join(names, ", "), fmt::join(blocks.missing, ", "),
      blocks.missing.size() == 1 ? "is" : "are");
}

}  // namespace splotchcl
