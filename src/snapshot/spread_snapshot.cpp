#include "splotchcl/spread_snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ranks/exchange.h"
#include "ranks/spread_particles.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/vector.h"

namespace splotchcl {
namespace {

// What a rank tells the others of its part of a snapshot that is spread over them.
struct SnapshotPart {
  SnapshotInfo info;  // types, time, box size
  Vec3 origin = {{0, 0, 0}};
};

class Writer {
 public:
  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    text_.append(bytes, sizeof(Value));
  }
  void put(const std::string& text) {
    put(text.size());
    text_ += text;
  }
  void put(const std::optional<double>& value) {
    put(value.has_value());
    put(value.value_or(0));
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  template <class Value>
  Value get() {
    Value value;
    std::memcpy(&value, rest_.data(), sizeof(Value));
    rest_.remove_prefix(sizeof(Value));
    return value;
  }
  std::string get_text() {
    const auto size = get<std::size_t>();
    std::string text(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return text;
  }
  std::optional<double> get_optional() {
    const bool is_there = get<bool>();
    const double value = get<double>();
    return is_there ? std::optional(value) : std::nullopt;
  }

 private:
  std::string_view rest_;
};

void put_type(const ParticleTypeInfo& type, Writer& out) {
  out.put(type.type);
  out.put(type.count);
  out.put(type.table_mass);
  out.put(type.fields.size());
  for (const FieldInfo& field : type.fields) {
    out.put(field.name);
    out.put(field.file_name);
    out.put(field.values_per_particle);
    out.put(field.unit);
  }
}

ParticleTypeInfo get_type(Reader& in) {
  ParticleTypeInfo type;
  type.type = in.get<int>();
  type.count = in.get<std::uint64_t>();
  type.table_mass = in.get_optional();
  type.fields.resize(in.get<std::size_t>());
  for (FieldInfo& field : type.fields) {
    field.name = in.get_text();
    field.file_name = in.get_text();
    field.values_per_particle = in.get<int>();
    field.unit = in.get_text();
  }
  return type;
}

std::string text_of(const std::optional<BoxSides>& box) {
  return box ? box->text() : "none";
}

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

void require_same(const std::string& what, std::size_t rank, const std::string& found,
                  const std::string& expected) {
  if (found == expected) return;
  throw UsageError(
      fmt::format("particles spread over processes: found {} {} on rank {}, expected that of rank "
                  "0, {}; give all ranks the same",
                  what, found, rank, expected));
}

// Which fields there are, with the number of their values, in any order.
std::string fields_of(const ParticleTypeInfo& type) {
  std::set<std::string> fields;
  for (const FieldInfo& field : type.fields)
    fields.insert(field.values_per_particle == 1
                      ? field.name
                      : fmt::format("{} ({} values)", field.name, field.values_per_particle));
  return fields.empty() ? "none" : fmt::format("{}", fmt::join(fields, ", "));
}

// A type as the ranks have it. One that has no particles need not say more of them.
class WholeType {
 public:
  void add(const ParticleTypeInfo& part, std::size_t rank) {
    if (!first_) {
      whole_ = part;
      first_ = rank;
      return;
    }
    const bool is_first_with_particles = whole_.count == 0 && part.count > 0;
    const std::uint64_t count = whole_.count + part.count;
    if (part.count > 0 && !is_first_with_particles) check(part, rank);
    if (is_first_with_particles) {
      whole_ = part;
      first_ = rank;
    }
    whole_.count = count;
  }
  const ParticleTypeInfo& whole() const { return whole_; }

 private:
  void check(const ParticleTypeInfo& part, std::size_t rank) const {
    check_alike("fields", part, rank, fields_of(part), fields_of(whole_));
    check_alike("the mass for all", part, rank, text_of(part.table_mass),
                text_of(whole_.table_mass));
  }
  void check_alike(const std::string& what, const ParticleTypeInfo& part, std::size_t rank,
                   const std::string& found, const std::string& expected) const {
    if (found == expected) return;
    throw UsageError(fmt::format(
        "particles of type {} spread over processes: found {} {} on rank {}, expected those of "
        "rank {}, {}; give all ranks with particles of the type the same",
        part.type, what, found, rank, *first_, expected));
  }

  ParticleTypeInfo whole_;
  std::optional<std::size_t> first_;  // the rank that says what it is like
};

std::string packed(const SnapshotPart& part) {
  Writer out;
  out.put(part.info.time);
  out.put(part.info.redshift);
  const std::optional<BoxSides>& box = part.info.box_size;
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.put(box ? (*box)[axis] : 0.0);
  for (const double x : part.origin.a)
    out.put(x);
  out.put(part.info.types.size());
  for (const ParticleTypeInfo& type : part.info.types)
    put_type(type, out);
  return out.take();
}

SnapshotPart unpacked(const std::string& text) {
  Reader in(text);
  SnapshotPart part;
  part.info.time = in.get<double>();
  part.info.redshift = in.get_optional();
  std::vector<double> sides;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sides.push_back(in.get<double>());
  part.info.box_size = box_of(sides);
  for (double& x : part.origin.a)
    x = in.get<double>();
  const auto types = in.get<std::size_t>();
  for (std::size_t t = 0; t < types; ++t)
    part.info.types.push_back(get_type(in));
  return part;
}

// The whole of which these are parts, by rank. Throws UsageError where they do not fit together.
SnapshotInfo whole_of(const std::vector<SnapshotPart>& parts) {
  const SnapshotPart& first = parts.front();
  std::map<int, WholeType> types;
  for (std::size_t rank = 0; rank < parts.size(); ++rank) {
    const SnapshotPart& part = parts[rank];
    require_same("a time of", rank, fmt::format("{}", part.info.time),
                 fmt::format("{}", first.info.time));
    require_same("a redshift of", rank, text_of(part.info.redshift), text_of(first.info.redshift));
    require_same("a box size of", rank, text_of(part.info.box_size), text_of(first.info.box_size));
    require_same("an origin of positions of", rank,
                 fmt::format("{}", fmt::join(part.origin.a, " ")),
                 fmt::format("{}", fmt::join(first.origin.a, " ")));
    for (const ParticleTypeInfo& type : part.info.types)
      types[type.type].add(type, rank);
  }
  SnapshotInfo whole = first.info;
  whole.types.clear();
  for (const auto& [number, type] : types)
    whole.types.push_back(type.whole());
  return whole;
}

std::uint64_t count_of(const SnapshotInfo& info, int type) {
  const ParticleTypeInfo* const known = info.find_type(type);
  return known == nullptr ? 0 : known->count;
}

}  // namespace

// A rank's particles under the names of the whole. Of types of which it has none the columns are
// empty.
class SpreadSnapshot::OwnPart final : public Snapshot {
 public:
  OwnPart(const ArraySnapshot& own, std::shared_ptr<SpreadParticles> spread, SnapshotInfo whole)
      : own_(own), spread_(std::move(spread)), info_(std::move(whole)) {
    for (ParticleTypeInfo& type : info_.types)
      type.count = count_of(own_.info(), type.type);
  }

  void set_first_place(int type, std::uint64_t place) { first_places_[type] = place; }

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override {
    const FieldInfo& info = require_field(info_, type, field);
    if (count_of(info_, type) == 0) return Column::owning({});
    return own_.read(type, info.name);
  }
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override {
    const FieldInfo& info = require_field(info_, type, field);
    if (count_of(info_, type) == 0) return {};
    return own_.read_integers(type, info.name);
  }
  std::uint64_t place_in_file(int type, std::uint64_t i) const override {
    return first_places_.at(type) + i;
  }
  Vec3 position_origin() const override { return own_.position_origin(); }
  std::shared_ptr<SpreadParticles> spread() const override { return spread_; }

 private:
  const ArraySnapshot& own_;
  std::shared_ptr<SpreadParticles> spread_;
  SnapshotInfo info_;
  std::map<int, std::uint64_t> first_places_;  // among those of all ranks
};

SpreadSnapshot::SpreadSnapshot(const ArraySnapshot& own, std::shared_ptr<Communicator> ranks)
    : own_(own), ranks_(std::move(ranks)) {
  if (!ranks_) {
    throw UsageError(
        "a snapshot that is spread over ranks: found no communicator, expected one; make it with "
        "splotchcl::ranks_of");
  }
  if (ranks_->size() > 1) spread_ = std::make_shared<SpreadParticles>(ranks_);
  changed();
}

SpreadSnapshot::~SpreadSnapshot() = default;

void SpreadSnapshot::changed() {
  own_.changed();
  memory().forget_own();
  if (!spread_) {
    info_ = own_.info();
    return;
  }
  std::vector<SnapshotPart> parts;
  for (const std::string& text :
       gather_texts(*ranks_, packed({own_.info(), own_.position_origin()})))
    parts.push_back(unpacked(text));
  spread_->agree_on([&] {
    info_ = whole_of(parts);
    info_.format = own_.info().format;
    info_.files = own_.info().files;
  });
  own_part_ = std::make_unique<OwnPart>(own_, spread_, info_);
  own_part_->share_lasting_memory_of(*this);
  for (const ParticleTypeInfo& type : info_.types) {
    std::uint64_t before = 0;
    for (int rank = 0; rank < ranks_->rank(); ++rank)
      before += count_of(parts[static_cast<std::size_t>(rank)].info, type.type);
    own_part_->set_first_place(type.type, before);
  }
}

Column SpreadSnapshot::read(int type, const std::string& field) const {
  if (!spread_) return own_.read(type, field);
  const FieldInfo& info = require_field(info_, type, field);
  return memory().get<Column>(fmt::format("type {}: field {} of all ranks", type, info.name), [&] {
    return spread_->spread(own_part_->read(type, field), count_of(own_part_->info(), type),
                           static_cast<std::size_t>(info.values_per_particle));
  });
}

const Snapshot& SpreadSnapshot::own_part() const {
  if (!own_part_) return *this;
  return *own_part_;
}

}  // namespace splotchcl
