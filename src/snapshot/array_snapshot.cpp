#include "splotchcl/array_snapshot.h"

#include <fmt/format.h>

#include <algorithm>

#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

void check(int type, const std::string& field, int values_per_particle, const void* values,
           std::uint64_t count) {
  constexpr int most_types = 32;
  if (type < 0 || type >= most_types) {
    throw UsageError(
        fmt::format("field {}: particle type {}, expected 0 to {}", field, type, most_types - 1));
  }
  if (field.empty()) throw UsageError(fmt::format("type {}: a field without a name", type));
  if (values_per_particle != 1 && values_per_particle != 3) {
    throw UsageError(fmt::format("field {} of type {}: {} values per particle, expected 1 or 3",
                                 field, type, values_per_particle));
  }
  if (canonical_field_name(field) == "position" && values_per_particle != 3) {
    throw UsageError(
        fmt::format("field {} of type {}: 1 value per particle, expected x, y and z", field, type));
  }
  if (values == nullptr && count > 0) {
    throw UsageError(
        fmt::format("field {} of type {}: a null pointer for {} particles", field, type, count));
  }
}

}  // namespace

ArraySnapshot::ArraySnapshot(const std::string& name_for_messages) {
  info_.format = "arrays in memory";
  info_.files = {name_for_messages};
}

ParticleTypeInfo& ArraySnapshot::type_info(int type) {
  const auto place = std::find_if(info_.types.begin(), info_.types.end(),
                                  [type](const ParticleTypeInfo& t) { return t.type >= type; });
  if (place != info_.types.end() && place->type == type) return *place;
  ParticleTypeInfo added;
  added.type = type;
  return *info_.types.insert(place, added);
}

void ArraySnapshot::add_field(int type, const std::string& field, std::uint64_t count,
                              int values_per_particle, const Column& column) {
  ParticleTypeInfo& info = type_info(type);
  const bool is_alone =
      info.fields.empty() || (info.fields.size() == 1 && info.fields.front().file_name == field);
  if (!is_alone && count != info.count) {
    throw UsageError(fmt::format(
        "field {} of type {}: {} particles, expected {} as in its other fields; clear the type "
        "when its number changes",
        field, type, count, info.count));
  }
  info.count = count;
  info.fields.erase(std::remove_if(info.fields.begin(), info.fields.end(),
                                   [&](const FieldInfo& f) { return f.file_name == field; }),
                    info.fields.end());
  info.fields.push_back({"", field, values_per_particle, ""});
  name_fields(info);
  changed();
  columns_[{type, field}] = column;
}

void ArraySnapshot::set_field(int type, const std::string& field, const float* values,
                              std::uint64_t count, int values_per_particle) {
  check(type, field, values_per_particle, values, count);
  const auto size = static_cast<std::size_t>(count) * static_cast<std::size_t>(values_per_particle);
  add_field(type, field, count, values_per_particle, Column(nullptr, values, size));
}

void ArraySnapshot::set_field(int type, const std::string& field, const double* values,
                              std::uint64_t count, int values_per_particle) {
  check(type, field, values_per_particle, values, count);
  const bool is_position = canonical_field_name(field) == "position";
  const auto size = static_cast<std::size_t>(count) * static_cast<std::size_t>(values_per_particle);
  std::vector<float> floats(size);
  for (std::size_t i = 0; i < size; ++i) {
    floats[i] = static_cast<float>(is_position ? values[i] - origin_.a[i % 3] : values[i]);
  }
  add_field(type, field, count, values_per_particle, Column::owning(std::move(floats)));
  has_double_positions_ = has_double_positions_ || is_position;
}

void ArraySnapshot::set_mass(int type, double mass) {
  type_info(type).table_mass = mass;
  changed();
}

void ArraySnapshot::changed() const {
  LoadMemory fresh;
  fresh.share_with(memory());
  memory() = fresh;
}

void ArraySnapshot::clear(int type) {
  changed();
  info_.types.erase(std::remove_if(info_.types.begin(), info_.types.end(),
                                   [type](const ParticleTypeInfo& t) { return t.type == type; }),
                    info_.types.end());
  for (auto column = columns_.begin(); column != columns_.end();)
    column = column->first.first == type ? columns_.erase(column) : std::next(column);
}

void ArraySnapshot::set_box_size(double size) {
  info_.box_size = size;
}

void ArraySnapshot::set_time(double time) {
  info_.time = time;
}

void ArraySnapshot::set_position_origin(const Vec3& origin) {
  if (has_double_positions_) {
    throw UsageError(
        "the origin is set after positions that are stored relative to it; set it "
        "first");
  }
  origin_ = origin;
}

Column ArraySnapshot::read(int type, const std::string& field) const {
  const FieldInfo& info = require_field(info_, type, field);
  return columns_.at({type, info.file_name});
}

}  // namespace splotchcl
