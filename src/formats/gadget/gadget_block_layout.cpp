#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>

#include "formats/gadget/gadget_blocks.h"
#include "formats/stored_values.h"
#include "splotchcl/error.h"

namespace splotchcl {

enum class Carriers { all, gas, stars, gas_and_stars, without_table_mass };

struct StandardBlock {
  std::string_view label;
  Carriers carriers;
  int values_per_particle;
  bool must_fit;  // else the label may mean something else in another code
};

namespace {

constexpr std::array<StandardBlock, 20> standard_blocks = {{
    {"POS", Carriers::all, 3, true},    {"VEL", Carriers::all, 3, true},
    {"ID", Carriers::all, 1, true},     {"MASS", Carriers::without_table_mass, 1, true},
    {"MASS", Carriers::all, 1, true},   {"U", Carriers::gas, 1, true},
    {"RHO", Carriers::gas, 1, true},    {"HSML", Carriers::gas, 1, true},
    {"HSML", Carriers::all, 1, true},   {"HSMS", Carriers::stars, 1, false},
    {"AGE", Carriers::stars, 1, false}, {"NE", Carriers::gas, 1, false},
    {"NH", Carriers::gas, 1, false},    {"SFR", Carriers::gas, 1, false},
    {"TEMP", Carriers::gas, 1, false},  {"Z", Carriers::gas_and_stars, 1, false},
    {"BFLD", Carriers::gas, 3, false},  {"POT", Carriers::all, 1, false},
    {"ACCE", Carriers::all, 3, false},  {"TSTP", Carriers::all, 1, false},
}};

constexpr TypeSet gas = 1U << 0;
constexpr TypeSet stars = 1U << 4;

ValueKind kind_of(bool is_wide) {
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

BlockLayouts::BlockLayouts(const GadgetHeader& header, std::uint64_t vector_bytes,
                           std::vector<BlockDescription> descriptions)
    : counts_(header.counts), descriptions_(std::move(descriptions)) {
  for (std::size_t type = 0; type < counts_.size(); ++type) {
    if (counts_[type] == 0) continue;
    present_ |= 1U << type;
    if (header.table_masses[type] == 0) without_table_mass_ |= 1U << type;
  }
  is_double_ = vector_bytes == particles_in(present_) * 3 * sizeof(double);
}

std::uint64_t BlockLayouts::particles_in(TypeSet types) const {
  std::uint64_t particles = 0;
  for (std::size_t type = 0; type < counts_.size(); ++type) {
    if ((types >> type & 1U) != 0) particles += counts_[type];
  }
  return particles;
}

std::optional<BlockLayout> BlockLayouts::fit(std::uint64_t bytes, TypeSet types, int values,
                                             bool is_wide) const {
  types &= present_;
  const std::uint64_t numbers = particles_in(types) * static_cast<std::uint64_t>(values);
  const BlockLayout layout = {types, values, kind_of(is_wide)};
  if (numbers == 0 || bytes != numbers * size_of(layout.kind)) return std::nullopt;
  return layout;
}

std::optional<BlockLayout> BlockLayouts::fit_ids(std::uint64_t bytes) const {
  for (const ValueKind kind : {ValueKind::uint32, ValueKind::uint64, ValueKind::uint48}) {
    if (bytes == particles_in(present_) * size_of(kind)) return BlockLayout{present_, 1, kind};
  }
  return std::nullopt;
}

TypeSet BlockLayouts::types_of(const StandardBlock& block) const {
  switch (block.carriers) {
    case Carriers::gas:
      return gas;
    case Carriers::stars:
      return stars;
    case Carriers::gas_and_stars:
      return gas | stars;
    case Carriers::without_table_mass:
      return without_table_mass_;
    case Carriers::all:
      break;
  }
  return present_;
}

std::optional<BlockLayout> BlockLayouts::fit_carriers(std::string_view label, std::uint64_t bytes,
                                                      bool is_wide, bool or_all) const {
  for (const StandardBlock& block : standard_blocks) {
    if (block.label != label) continue;
    const int values = block.values_per_particle;
    if (const auto layout = fit(bytes, types_of(block), values, is_wide)) return layout;
    if (!or_all) continue;
    if (const auto layout = fit(bytes, present_, values, is_wide)) return layout;
  }
  return std::nullopt;
}

bool BlockLayouts::may_be_of_fewer(std::string_view label, const BlockLayout& layout) const {
  const std::uint64_t bytes = particles_in(layout.types) *
                              static_cast<std::uint64_t>(layout.values_per_particle) *
                              size_of(layout.kind);
  const auto other = label == "ID" ? std::nullopt : fit_carriers(label, bytes, !is_double_, false);
  return other && particles_in(other->types) < particles_in(layout.types);
}

// Numbers of single precision for two types are as long as those of double precision for one of
// them, if this has as many particles as the other.
std::optional<BlockLayout> BlockLayouts::fit_standard(std::string_view label, std::uint64_t bytes,
                                                      bool or_all) const {
  if (label == "ID") return fit_ids(bytes);
  const auto like_vectors = fit_carriers(label, bytes, is_double_, or_all);
  return like_vectors ? like_vectors : fit_carriers(label, bytes, !is_double_, false);
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
        const BlockLayout layout = {types, values, kind_of(is_wide)};
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

namespace {

constexpr std::uint32_t header_bytes = 256;
constexpr std::uint32_t label_bytes = 8;  // four letters and the length of what follows
constexpr std::uint64_t mark_bytes = 4;

struct Recognized {
  int format;
  bool is_swapped;
};

std::optional<Recognized> recognize(const MappedFile& file) {
  if (file.size() < mark_bytes) return std::nullopt;
  std::uint32_t mark = 0;
  std::memcpy(&mark, file.data(), sizeof mark);
  for (const bool is_swapped : {false, true}) {
    const std::uint32_t value = is_swapped ? __builtin_bswap32(mark) : mark;
    if (value == header_bytes) return Recognized{1, is_swapped};
    if (value == label_bytes) return Recognized{2, is_swapped};
  }
  return std::nullopt;
}

// Reads numbers of the file's endianness at places inside the file.
class Numbers {
 public:
  Numbers(std::shared_ptr<const MappedFile> file, bool is_swapped)
      : file_(std::move(file)), is_swapped_(is_swapped) {}

  std::uint32_t uint32(std::uint64_t offset) const {
    return static_cast<std::uint32_t>(number_at(file_, offset, ValueKind::uint32, is_swapped_));
  }
  double float64(std::uint64_t offset) const {
    return number_at(file_, offset, ValueKind::float64, is_swapped_);
  }

 private:
  std::shared_ptr<const MappedFile> file_;
  bool is_swapped_;
};

class RecordWalker {
 public:
  RecordWalker(const MappedFile& file, const Numbers& numbers) : file_(file), numbers_(numbers) {}

  bool is_at_end() const { return position_ >= file_.size(); }

  GadgetRecord next() {
    if (file_.size() - position_ < mark_bytes) {
      throw DataError(
          fmt::format("{}: truncated: the file ends inside the record mark at byte {}; copy or "
                      "write the file again",
                      file_.path().string(), position_));
    }
    const std::uint32_t mark = numbers_.uint32(position_);
    const std::uint64_t available = file_.size() - position_;
    // Marks have 32 bits: a record of 4 GiB and more is as long as its mark says, plus a
    // multiple of 2^32. The closing mark tells which.
    constexpr std::uint64_t wrap = std::uint64_t{1} << 32;
    for (std::uint64_t bytes = mark; bytes + 2 * mark_bytes <= available; bytes += wrap) {
      if (numbers_.uint32(position_ + mark_bytes + bytes) != mark) continue;
      const GadgetRecord record = {"", position_ + mark_bytes, bytes};
      position_ += bytes + 2 * mark_bytes;
      return record;
    }
    throw_bad_record(mark, available);
  }

 private:
  [[noreturn]] void throw_bad_record(std::uint32_t mark, std::uint64_t available) const {
    if (mark + 2 * mark_bytes > available) {
      throw DataError(fmt::format(
          "{}: truncated: the record at byte {} should have {} bytes, but the file ends {} bytes "
          "after its start; copy or write the file again",
          file_.path().string(), position_, mark, available));
    }
    throw DataError(fmt::format(
        "{}: the record at byte {} opens with the length {} but closes with {}; the file is "
        "damaged or not in Gadget format",
        file_.path().string(), position_, mark, numbers_.uint32(position_ + mark_bytes + mark)));
  }

  const MappedFile& file_;
  const Numbers& numbers_;
  std::uint64_t position_ = 0;
};

std::string read_label(const MappedFile& file, const GadgetRecord& record) {
  if (record.bytes != label_bytes) {
    throw DataError(fmt::format(
        "{}: the record at byte {} has {} bytes where the 8 bytes of a block's label were "
        "expected; the file is damaged or not in Gadget format 2",
        file.path().string(), record.offset - mark_bytes, record.bytes));
  }
  std::string label(reinterpret_cast<const char*>(file.data()) + record.offset, 4);
  std::replace(label.begin(), label.end(), '\0', ' ');
  if (!std::all_of(label.begin(), label.end(), [](char c) { return c >= ' ' && c <= '~'; })) {
    throw DataError(fmt::format(
        "{}: the label at byte {} is not made of letters; the file is damaged or not in Gadget "
        "format 2",
        file.path().string(), record.offset));
  }
  label.erase(label.find_last_not_of(' ') + 1);
  return label;
}

// Places in the header, in bytes. Arrays have an entry for each of the six types.
namespace at {
constexpr std::uint64_t counts = 0, table_masses = 24, time = 72, redshift = 80;
constexpr std::uint64_t star_formation = 88, total_counts = 96, cooling = 120, files = 124;
constexpr std::uint64_t box_size = 128, omega_matter = 136, omega_lambda = 144;
constexpr std::uint64_t hubble_parameter = 152, stellar_age = 160, metals = 164,
                        total_counts_high = 168;
}  // namespace at

GadgetHeader read_header(const GadgetRecord& record, const Numbers& numbers) {
  GadgetHeader header;
  const auto uint32 = [&](std::uint64_t place) { return numbers.uint32(record.offset + place); };
  const auto float64 = [&](std::uint64_t place) { return numbers.float64(record.offset + place); };
  for (std::uint64_t type = 0; type < 6; ++type) {
    header.counts.push_back(uint32(at::counts + 4 * type));
    header.table_masses.push_back(float64(at::table_masses + 8 * type));
    header.total_counts.push_back(uint32(at::total_counts + 4 * type));
    header.total_counts_high.push_back(uint32(at::total_counts_high + 4 * type));
  }
  header.time = float64(at::time);
  header.redshift = float64(at::redshift);
  header.has_star_formation = uint32(at::star_formation) == 1;
  header.has_cooling = uint32(at::cooling) == 1;
  // Beyond an int it is damage, which the first file that is missing brings to light.
  constexpr std::uint32_t most_files = std::numeric_limits<std::int32_t>::max();
  header.files = static_cast<int>(std::min(uint32(at::files), most_files));
  header.box_size = float64(at::box_size);
  header.omega_matter = float64(at::omega_matter);
  header.omega_lambda = float64(at::omega_lambda);
  header.hubble_parameter = float64(at::hubble_parameter);
  header.has_stellar_age = uint32(at::stellar_age) == 1;
  header.has_metals = uint32(at::metals) == 1;
  return header;
}

void check_header_record(const MappedFile& file, int format, const GadgetRecord& record) {
  if (record.bytes == header_bytes && (format == 1 || record.label == "HEAD")) return;
  throw DataError(
      fmt::format("{}: the first block is '{}' with {} bytes; expected the header HEAD with {} "
                  "bytes: the file is damaged or not in Gadget format {}",
                  file.path().string(), record.label, record.bytes, header_bytes, format));
}

// A tail of zeros reads as empty records without end.
constexpr std::size_t most_blocks = 10000;

[[noreturn]] void throw_too_many_blocks(const MappedFile& file) {
  throw DataError(fmt::format(
      "{}: more than {} blocks, of which a snapshot has some dozens; the file is damaged, or was "
      "not completely written: copy or write it again",
      file.path().string(), most_blocks));
}

}  // namespace

bool is_gadget_binary(const MappedFile& file) {
  return recognize(file).has_value();
}

GadgetBinaryFile read_gadget_records(std::shared_ptr<const MappedFile> file) {
  const std::optional<Recognized> recognized = recognize(*file);
  if (!recognized) {
    throw DataError(fmt::format(
        "{}: not in Gadget format 1 or 2, as the other files of its snapshot are; check the name",
        file->path().string()));
  }
  const Numbers numbers(file, recognized->is_swapped);
  RecordWalker walker(*file, numbers);
  const auto next_block = [&] {
    if (recognized->format == 1) return walker.next();
    std::string label = read_label(*file, walker.next());
    GadgetRecord record = walker.next();
    record.label = std::move(label);
    return record;
  };
  GadgetBinaryFile result;
  result.format = recognized->format;
  result.is_swapped = recognized->is_swapped;
  const GadgetRecord header = next_block();
  check_header_record(*file, recognized->format, header);
  result.header = read_header(header, numbers);
  while (!walker.is_at_end()) {
    result.records.push_back(next_block());
    if (result.records.size() > most_blocks) throw_too_many_blocks(*file);
  }
  result.file = std::move(file);
  return result;
}

}  // namespace splotchcl
