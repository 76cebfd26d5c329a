#include "formats/gadget/gadget_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The records of format 1, which has no labels, told apart by the usual order of blocks.
struct OrderedBlocks {
  std::vector<GadgetBlock> standard;
  std::vector<std::size_t> others;   // records that are none of the standard blocks
  std::vector<std::string> skipped;  // expected, but the next record is something else
  std::vector<std::string> missing;  // expected after the last record
};

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

// What was assumed or found missing; empty where nothing was.
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

using Notes = std::vector<std::string>;

constexpr std::uint64_t description_bytes = 40;  // label, type name, dimensions, six flags

std::uint32_t load_uint32(const GadgetBinaryFile& file, std::uint64_t offset) {
  return static_cast<std::uint32_t>(
      number_at(file.file, offset, ValueKind::uint32, file.is_swapped));
}

std::string text_at(const GadgetBinaryFile& file, std::uint64_t offset, std::size_t length) {
  std::string text(reinterpret_cast<const char*>(file.file->data()) + offset, length);
  text.erase(text.find_last_not_of(std::string("\0 ", 2)) + 1);
  return text;
}

ValueKind kind_of_name(const std::string& name) {
  if (name == "LONG") return ValueKind::uint32;
  if (name == "LLONG") return ValueKind::uint64;
  if (name == "DOUBLE" || name == "DOUBLEN") return ValueKind::float64;
  return ValueKind::float32;
}

BlockDescription read_description(const GadgetBinaryFile& file, std::uint64_t offset) {
  BlockDescription description;
  description.label = text_at(file, offset, 4);
  description.layout.kind = kind_of_name(text_at(file, offset + 4, 8));
  constexpr std::uint32_t beyond_any_block = 1U << 20;  // fits no block's length
  description.layout.values_per_particle =
      static_cast<int>(std::min(load_uint32(file, offset + 12), beyond_any_block));
  for (unsigned type = 0; type < 6; ++type) {
    if (load_uint32(file, offset + 16 + 4 * type) != 0) description.layout.types |= 1U << type;
  }
  return description;
}

std::vector<BlockDescription> read_descriptions(const GadgetBinaryFile& file) {
  std::vector<BlockDescription> descriptions;
  for (const GadgetRecord& record : file.records) {
    if (record.label != "INFO" || record.bytes % description_bytes != 0) continue;
    for (std::uint64_t at = 0; at < record.bytes; at += description_bytes) {
      descriptions.push_back(read_description(file, record.offset + at));
    }
  }
  return descriptions;
}

std::string list_counts(const GadgetHeader& header) {
  return fmt::format("{}", fmt::join(header.counts, " "));
}

[[noreturn]] void throw_bad_length(const GadgetBinaryFile& file, const std::string& label,
                                   std::uint64_t bytes) {
  throw DataError(fmt::format(
      "{}: block {} has {} bytes, which contradicts the header's numbers of particles ({} of types "
      "0 to 5); the file is damaged or its header is wrong",
      file.file->path().string(), label, bytes, list_counts(file.header)));
}

[[noreturn]] void throw_no_positions(const GadgetBinaryFile& file) {
  Notes labels;
  for (const GadgetRecord& record : file.records)
    labels.push_back(record.label);
  const std::string found =
      labels.empty() ? "no blocks at all" : fmt::format("only {}", fmt::join(labels, ", "));
  throw DataError(
      fmt::format("{}: no positions: the file has {}; expected a block POS: the file is "
                  "incomplete, or no snapshot",
                  file.file->path().string(), found));
}

// Codes with positions in double precision may have all else in single precision, so velocities
// tell more. Three values for each particle, nothing else is as long in format 1.
std::uint64_t bytes_of_vectors(const GadgetBinaryFile& file) {
  const auto positions =
      std::find_if(file.records.begin(), file.records.end(),
                   [&](const GadgetRecord& r) { return file.format == 1 || r.label == "POS"; });
  if (positions == file.records.end()) throw_no_positions(file);
  const auto velocities =
      std::find_if(file.format == 1 ? positions + 1 : file.records.begin(), file.records.end(),
                   [&](const GadgetRecord& r) { return file.format == 1 || r.label == "VEL"; });
  const bool are_vectors =
      velocities != file.records.end() &&
      (velocities->bytes == positions->bytes || velocities->bytes == positions->bytes / 2 ||
       velocities->bytes == positions->bytes * 2);
  return are_vectors ? velocities->bytes : positions->bytes;
}

std::string several_fit(const std::string& label, const BlockLayout& layout) {
  std::vector<int> types;
  for (int type = 0; type < 6; ++type) {
    if ((layout.types >> type & 1U) != 0) types.push_back(type);
  }
  return fmt::format(
      "block {} fits several sets of particle types by its length; taken for type {}", label,
      fmt::join(types, " and "));
}

// A block whose meaning only its length tells.
void add_by_length(const BlockLayouts& layouts, const GadgetRecord& record,
                   const std::string& label, std::vector<GadgetBlock>& blocks, Notes& notes) {
  bool is_ambiguous = false;
  const auto layout = layouts.fit_any(record.bytes, is_ambiguous);
  if (!layout) {
    notes.push_back(
        fmt::format("block {} left out: its {} bytes fit one or three values of no set of particle "
                    "types",
                    label, record.bytes));
    return;
  }
  if (is_ambiguous) notes.push_back(several_fit(label, *layout));
  blocks.push_back({label, record.offset, *layout});
}

std::vector<GadgetBlock> understand_labelled(const GadgetBinaryFile& file,
                                             const BlockLayouts& layouts, Notes& notes) {
  std::vector<GadgetBlock> blocks;
  std::vector<std::string> seen;
  for (const GadgetRecord& record : file.records) {
    if (record.bytes == 0 || record.label == "INFO") continue;
    if (std::find(seen.begin(), seen.end(), record.label) != seen.end()) {
      notes.push_back(
          fmt::format("block {} occurs more than once; the first is used", record.label));
      continue;
    }
    seen.push_back(record.label);
    auto layout = layouts.fit_description(record.label, record.bytes);
    const bool is_drawable =
        !layout || layout->values_per_particle == 1 || layout->values_per_particle == 3;
    if (!is_drawable && !is_standard_block(record.label)) {
      notes.push_back(fmt::format("block {} left out: it has {} values per particle, not 1 or 3",
                                  record.label, layout->values_per_particle));
      continue;
    }
    if (!layout || !is_drawable) {
      layout = layouts.fit_standard(record.label, record.bytes, true);
      const bool is_unsure = layout && layouts.may_be_of_fewer(record.label, *layout);
      if (is_unsure) notes.push_back(several_fit(record.label, *layout));
    }
    if (layout) {
      blocks.push_back({record.label, record.offset, *layout});
    } else if (is_standard_block(record.label)) {
      throw_bad_length(file, record.label, record.bytes);
    } else {
      add_by_length(layouts, record, record.label, blocks, notes);
    }
  }
  return blocks;
}

std::vector<GadgetBlock> understand_unlabelled(const GadgetBinaryFile& file,
                                               const BlockLayouts& layouts, Notes& notes) {
  OrderedBlocks found = order_blocks(file, layouts);
  const bool has_positions = !found.standard.empty() && found.standard.front().label == "POS";
  if (!has_positions) {
    throw_bad_length(file, "POS (the first of the file)", file.records.front().bytes);
  }
  std::string order = describe_order(found, layouts);
  if (!order.empty()) notes.push_back(std::move(order));
  std::vector<GadgetBlock> blocks = std::move(found.standard);
  const std::size_t known = blocks.size();
  for (const std::size_t i : found.others) {
    add_by_length(layouts, file.records[i], fmt::format("block_{}", i + 1), blocks, notes);
  }
  if (blocks.size() > known) {
    Notes names;
    for (std::size_t i = known; i < blocks.size(); ++i)
      names.push_back(blocks[i].label);
    notes.push_back(fmt::format("format 1 has no labels: the blocks after the usual ones are {}",
                                fmt::join(names, ", ")));
  }
  return blocks;
}

}  // namespace

void count_by_blocks(GadgetBinaryFile& file, Notes& notes) {
  GadgetHeader& header = file.header;
  if (header.particles() > 0 || header.files > 1 || file.records.empty()) return;
  const auto bytes_of = [&](std::string_view label, std::size_t place) -> std::uint64_t {
    for (std::size_t i = 0; i < file.records.size(); ++i) {
      const bool is_it = file.format == 1 ? i == place : file.records[i].label == label;
      if (is_it) return file.records[i].bytes;
    }
    return 0;
  };
  const std::uint64_t positions = bytes_of("POS", 0), ids = bytes_of("ID", 2);
  // In single precision unless the identifiers fit only doubles.
  for (const std::uint64_t bytes : {std::uint64_t{12}, std::uint64_t{24}}) {
    const std::uint64_t particles = positions / bytes;
    const bool fits_ids =
        ids == 0 || ids == 4 * particles || ids == 6 * particles || ids == 8 * particles;
    if (particles == 0 || positions % bytes != 0 || !fits_ids) continue;
    // All are gas where the blocks of gas have a value for each.
    const bool is_gas = file.format == 2 && bytes_of("U", 0) == particles * bytes / 3;
    header.counts[is_gas ? 0 : 1] = particles;
    std::fill(header.total_counts.begin(), header.total_counts.end(), 0);
    std::fill(header.total_counts_high.begin(), header.total_counts_high.end(), 0);
    notes.push_back(fmt::format(
        "the header counts no particles; by their positions there are {}, taken for type {}",
        particles, is_gas ? 0 : 1));
    return;
  }
}

std::vector<GadgetBlock> understand_records(const GadgetBinaryFile& file, Notes& notes) {
  if (file.header.particles() == 0) return {};
  const BlockLayouts layouts(file.header, bytes_of_vectors(file), read_descriptions(file));
  return file.format == 1 ? understand_unlabelled(file, layouts, notes)
                          : understand_labelled(file, layouts, notes);
}

}  // namespace splotchcl
