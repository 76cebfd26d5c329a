// Gadget formats 1 and 2: one or more files of Fortran-like records.
#include <fmt/format.h>

#include <algorithm>

#include "formats/gadget/gadget_blocks.h"
#include "formats/gadget/gadget_header.h"
#include "formats/snapshot_format.h"
#include "formats/stored_values.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

struct Member {
  GadgetBinaryFile file;
  std::vector<GadgetBlock> blocks;

  const GadgetHeader& header() const { return file.header; }
  std::uint64_t count(int type) const { return header().counts[static_cast<std::size_t>(type)]; }
  // The values of one type in a block; nothing when the block is not for the type.
  std::optional<StoredValues> find_values(const std::string& label, int type) const;
};

std::optional<StoredValues> Member::find_values(const std::string& label, int type) const {
  for (const GadgetBlock& block : blocks) {
    const bool is_for_type = (block.layout.types >> type & 1U) != 0;
    if (block.label != label || !is_for_type) continue;
    StoredValues values = {
        file.file, block.offset,      count(type),    block.layout.values_per_particle,
        0,         block.layout.kind, file.is_swapped};
    for (int before = 0; before < type; ++before) {
      if ((block.layout.types >> before & 1U) == 0) continue;
      values.offset += count(before) * values.packed_bytes_per_particle();
    }
    return values;
  }
  return std::nullopt;
}

Member read_member(const std::filesystem::path& path, std::vector<std::string>& notes) {
  Member member;
  member.file = read_gadget_records(MappedFile::open(path));
  count_by_blocks(member.file, notes);
  member.blocks = understand_records(member.file, notes);
  check_header(member.header(), path);
  return member;
}

class GadgetBinarySnapshot : public Snapshot {
 public:
  explicit GadgetBinarySnapshot(const std::filesystem::path& path);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  Vec3 position_origin() const override { return origin_; }

 private:
  std::vector<StoredValues> find_parts(int type, const std::string& label) const;
  std::vector<const GadgetBlock*> blocks_of_all_members(int type) const;
  bool is_in_every_member(int type, const GadgetBlock& block) const;
  void find_fields(ParticleTypeInfo& type);
  void choose_origin();

  std::vector<Member> members_;
  SnapshotInfo info_;
  Vec3 origin_ = {{0, 0, 0}};
};

GadgetBinarySnapshot::GadgetBinarySnapshot(const std::filesystem::path& path) {
  members_ = read_members(path, read_member, info_);
  info_.files_mark = hash_of_files(info_).value();
  const GadgetBinaryFile& first = members_.front().file;
  info_.format = fmt::format("Gadget format {}, {}-endian", first.format,
                             first.is_swapped == is_little_endian_host() ? "big" : "little");
  note_other_scale_factor(info_);
  for (ParticleTypeInfo& type : info_.types)
    find_fields(type);
  choose_origin();
}

std::vector<const GadgetBlock*> GadgetBinarySnapshot::blocks_of_all_members(int type) const {
  std::vector<const GadgetBlock*> blocks;
  for (const Member& member : members_) {
    if (member.count(type) == 0) continue;
    for (const GadgetBlock& block : member.blocks) {
      if ((block.layout.types >> type & 1U) != 0) add_if_new(block, blocks);
    }
  }
  return blocks;
}

bool GadgetBinarySnapshot::is_in_every_member(int type, const GadgetBlock& block) const {
  return std::all_of(members_.begin(), members_.end(), [&](const Member& member) {
    if (member.count(type) == 0) return true;
    const auto values = member.find_values(block.label, type);
    return values && values->values_per_particle == block.layout.values_per_particle;
  });
}

void GadgetBinarySnapshot::find_fields(ParticleTypeInfo& type) {
  for (const GadgetBlock* const block : blocks_of_all_members(type.type)) {
    if (!is_in_every_member(type.type, *block)) {
      info_.notes.push_back(fmt::format(
          "block {} of type {} left out: not every file of the snapshot has it in the same form",
          block->label, type.type));
      continue;
    }
    type.fields.push_back({"", block->label, block->layout.values_per_particle, ""});
  }
  add_table_mass(type, "mass table", info_.notes);
  name_fields(type);
}

std::vector<StoredValues> GadgetBinarySnapshot::find_parts(int type,
                                                           const std::string& label) const {
  std::vector<StoredValues> parts;
  for (const Member& member : members_) {
    if (const auto values = member.find_values(label, type)) parts.push_back(*values);
  }
  return parts;
}

void GadgetBinarySnapshot::choose_origin() {
  std::vector<StoredValues> parts;
  std::vector<std::uint64_t> sizes;
  for (const ParticleTypeInfo& type : info_.types) {
    for (const StoredValues& part : find_parts(type.type, "POS")) {
      parts.push_back(part);
      sizes.push_back(part.particles);
    }
  }
  const bool has_doubles = std::any_of(parts.begin(), parts.end(), [](const StoredValues& part) {
    return part.kind == ValueKind::float64;
  });
  if (!has_doubles) return;
  std::vector<std::array<double, 3>> sample;
  for (const SampleRange& range : sample_ranges(sizes)) {
    const StoredValues& part = parts[range.part];
    for (std::uint64_t i = range.first; i < range.first + range.count; ++i) {
      sample.push_back({value_at(part, i, 0), value_at(part, i, 1), value_at(part, i, 2)});
    }
  }
  origin_ = choose_position_origin(sample);
}

Column GadgetBinarySnapshot::read(int type, const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  const std::optional<double> table_mass = require_type(info_, type).table_mass;
  if (field.name == "mass" && table_mass) {
    return Column::uniform(static_cast<float>(*table_mass));
  }
  const Vec3 origin = field.name == "position" ? origin_ : Vec3{{0, 0, 0}};
  return make_column(find_parts(type, field.file_name), origin);
}

std::vector<std::uint64_t> GadgetBinarySnapshot::read_integers(int type,
                                                               const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  auto numbers = make_integers(find_parts(type, field.file_name));
  if (!numbers) refuse_integers(info_, type, field);
  return std::move(*numbers);
}

class GadgetBinaryFormat : public SnapshotFormat {
 public:
  bool recognizes(const std::shared_ptr<const MappedFile>& file) const override {
    return is_gadget_binary(*file);
  }
  std::unique_ptr<Snapshot> open(const std::filesystem::path& path,
                                 const SnapshotOptions&) const override {
    return std::make_unique<GadgetBinarySnapshot>(path);
  }
};

}  // namespace

const SnapshotFormat& gadget_binary_format() {
  static const GadgetBinaryFormat format;
  return format;
}

}  // namespace splotchcl
