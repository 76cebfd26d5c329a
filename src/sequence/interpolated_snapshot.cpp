#include "sequence/interpolated_snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "between/interpolation.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Quantities that span powers of ten and are never 0: between 1 and 100 lies 10.
bool is_logarithmic(const std::string& field) {
  constexpr std::array<const char*, 8> fields = {
      "density",     "smoothing_length", "star_smoothing_length",
      "temperature", "internal_energy",  "pressure",
      "entropy",     "softening"};
  return std::any_of(fields.begin(), fields.end(),
                     [&field](const char* name) { return field == name; });
}

double between(double first, double second, double fraction) {
  return first + fraction * (second - first);
}

// Of a type that only one of the snapshots has, everything; else what both have.
std::vector<FieldInfo> fields_in_common(const ParticleTypeInfo* first,
                                        const ParticleTypeInfo* second) {
  if (second == nullptr) return first->fields;
  if (first == nullptr) return second->fields;
  std::vector<FieldInfo> fields;
  for (const FieldInfo& field : first->fields) {
    const FieldInfo* const other = find_field(*second, field.name);
    const bool is_same =
        other != nullptr && other->values_per_particle == field.values_per_particle;
    if (is_same) fields.push_back(field);
  }
  return fields;
}

}  // namespace

InterpolatedSnapshot::InterpolatedSnapshot(std::shared_ptr<const SnapshotPair> pair,
                                           double fraction)
    : pair_(std::move(pair)), fraction_(fraction) {
  describe_moment();
  for (const auto& [type, match] : pair_->matches)
    describe_type(type, *match);
}

void InterpolatedSnapshot::describe_moment() {
  const SnapshotInfo& first = pair_->first->info();
  const SnapshotInfo& second = pair_->second->info();
  info_ = first;
  info_.has_positions_of_files = false;
  info_.types.clear();
  info_.notes.insert(info_.notes.end(), pair_->notes.begin(), pair_->notes.end());
  info_.time = between(first.time, second.time, fraction_);
  if (first.cosmology && second.cosmology) {
    info_.cosmology->scale_factor =
        between(first.cosmology->scale_factor, second.cosmology->scale_factor, fraction_);
    info_.redshift = 1 / info_.cosmology->scale_factor - 1;
  } else if (first.redshift && second.redshift) {
    info_.redshift = between(*first.redshift, *second.redshift, fraction_);
  }
  if (first.box_size != second.box_size) info_.box_size.reset();
}

void InterpolatedSnapshot::describe_type(int type, const IdMatch& match) {
  const ParticleTypeInfo* const first = pair_->first->info().find_type(type);
  const ParticleTypeInfo* const second = pair_->second->info().find_type(type);
  ParticleTypeInfo described;
  described.type = type;
  described.count = match.place_in_second.size() + match.appearing.size();
  described.fields = fields_in_common(first, second);
  const ParticleTypeInfo& known = first != nullptr ? *first : *second;
  described.particles_per_drawn = known.particles_per_drawn;
  const bool has_one_mass = second == nullptr || known.table_mass == second->table_mass;
  if (has_one_mass) described.table_mass = known.table_mass;
  const bool some_fade = !match.appearing.empty() || match.in_common < match.place_in_second.size();
  if (some_fade) described.fields.push_back({fade_field, "", 1, ""});
  for (const ParticleTypeInfo* const own : {first, second}) {
    if (own == nullptr) continue;
    for (const FieldInfo& field : own->fields) {
      if (find_field(described, field.name) != nullptr) continue;
      info_.notes.push_back(fmt::format(
          "field {} of type {} left out: only one of two snapshots has it", field.name, type));
    }
  }
  info_.types.push_back(std::move(described));
}

Column InterpolatedSnapshot::read(int type, const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  const TypeField key = {type, field.name};
  const std::lock_guard lock(mutex_);
  const auto found = columns_.find(key);
  if (found != columns_.end()) return found->second;
  return columns_[key] = interpolate(type, field);
}

Column InterpolatedSnapshot::interpolate(int type, const FieldInfo& field) const {
  const std::shared_ptr<const IdMatch>& match = pair_->matches.at(type);
  if (field.name == "position") {
    return column_between(interpolate_positions(pair_->path(type), match, fraction_));
  }
  ColumnBetween column;
  column.match = match;
  column.fraction = static_cast<float>(fraction_);
  if (field.name == fade_field && field.file_name.empty()) {
    column.first = column.second = Column::uniform(1);
    column.fades = true;
    column.vanishing = static_cast<float>(1 - fraction_);
    column.appearing = column.fraction;
    return column_between(std::move(column));
  }
  column.first = read_or_nothing(*pair_->first, type, field.name);
  column.second = read_or_nothing(*pair_->second, type, field.name);
  column.values_per_particle = field.values_per_particle;
  // There is nothing between two ids, nor between two haloes.
  if (field.name == "id" || field.name == "halo_id") column.fraction = 0;
  if (is_logarithmic(field.name)) column.kind = ColumnBetween::Kind::logarithmic;
  return column_between(std::move(column));
}

std::vector<std::uint64_t> InterpolatedSnapshot::whole_numbers(
    int type, const std::function<std::vector<std::uint64_t>(const Snapshot&)>& read) const {
  std::vector<std::uint64_t> numbers;
  if (pair_->first->info().find_type(type) != nullptr) numbers = read(*pair_->first);
  const std::vector<std::uint32_t>& appearing = pair_->matches.at(type)->appearing;
  if (appearing.empty()) return numbers;
  const std::vector<std::uint64_t> of_second = read(*pair_->second);
  for (const std::uint32_t place : appearing)
    numbers.push_back(of_second[place]);
  return numbers;
}

std::vector<std::uint64_t> InterpolatedSnapshot::read_ids(int type) const {
  require_type(info_, type);
  return whole_numbers(type, [type](const Snapshot& s) { return s.read_ids(type); });
}

void InterpolatedSnapshot::refuse_haloes() const {
  throw UsageError(fmt::format(
      "{}: between two snapshots there are no numbers of haloes, expected time.interpolation "
      "\"none\", or select.ids with the particles of the halo",
      info_.files.front().string()));
}

std::vector<std::uint64_t> InterpolatedSnapshot::read_integers(int type,
                                                               const std::string& name) const {
  const std::string field = require_field(info_, type, name).name;
  if (field == "halo_id") refuse_haloes();
  return whole_numbers(type, [&](const Snapshot& s) { return s.read_integers(type, field); });
}

std::uint64_t InterpolatedSnapshot::place_in_file(int, std::uint64_t) const {
  refuse_haloes();
}

}  // namespace splotchcl
