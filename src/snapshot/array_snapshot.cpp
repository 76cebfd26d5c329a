#include "splotchcl/array_snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

void check_type(int type, const std::string& what) {
  constexpr int most_types = 32;
  if (type >= 0 && type < most_types) return;
  throw UsageError(
      fmt::format("{}: particle type {}, expected 0 to {}", what, type, most_types - 1));
}

template <typename Value>
constexpr const char* name_of() {
  if (std::is_integral_v<Value>) return "whole numbers of 64 bits";
  return sizeof(Value) == sizeof(float) ? "floats" : "doubles";
}

template <typename Value>
void check(int type, const std::string& field, int values_per_particle, const Value* values,
           std::uint64_t count) {
  check_type(type, fmt::format("field {}", field));
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
  if (reinterpret_cast<std::uintptr_t>(values) % alignof(Value) != 0) {
    throw UsageError(fmt::format(
        "field {} of type {}: the values do not lie at a multiple of {} bytes, expected an array "
        "of {} as the compiler lays it out",
        field, type, alignof(Value), name_of<Value>()));
  }
  // No array is longer than what a difference of two pointers can say.
  constexpr std::uint64_t most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(Value);
  if (count > most / static_cast<std::uint64_t>(values_per_particle)) {
    throw UsageError(fmt::format(
        "field {} of type {}: {} particles of {} values do not fit into memory, expected up to {}",
        field, type, count, values_per_particle,
        most / static_cast<std::uint64_t>(values_per_particle)));
  }
}

// What a type is where none of its fields has been set.
ParticleTypeInfo empty_type(int type) {
  ParticleTypeInfo info;
  info.type = type;
  return info;
}

}  // namespace

ArraySnapshot::ArraySnapshot(const std::string& name_for_messages) {
  info_.format = "arrays in memory";
  info_.files = {name_for_messages};
  info_.has_positions_of_files = false;  // a file may have that name
}

// In the order of types.
void ArraySnapshot::replace(ParticleTypeInfo info) {
  const auto place = std::find_if(info_.types.begin(), info_.types.end(),
                                  [&](const ParticleTypeInfo& t) { return t.type >= info.type; });
  if (place != info_.types.end() && place->type == info.type) {
    *place = std::move(info);
  } else {
    info_.types.insert(place, std::move(info));
  }
}

// Where it throws, all is as it was.
void ArraySnapshot::add_field(int type, const std::string& field, std::uint64_t count,
                              int values_per_particle, Values values) {
  const ParticleTypeInfo* const known = info_.find_type(type);
  ParticleTypeInfo info = known == nullptr ? empty_type(type) : *known;
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
  values_[{type, field}] = std::move(values);
  replace(std::move(info));
}

void ArraySnapshot::set_field(int type, const std::string& field, const float* values,
                              std::uint64_t count, int values_per_particle) {
  set_field(type, field, values, count, values_per_particle, nullptr);
}

void ArraySnapshot::set_field(int type, const std::string& field, const float* values,
                              std::uint64_t count, int values_per_particle,
                              std::shared_ptr<const void> owner) {
  check(type, field, values_per_particle, values, count);
  const auto size = static_cast<std::size_t>(count) * static_cast<std::size_t>(values_per_particle);
  add_field(type, field, count, values_per_particle, {Column(std::move(owner), values, size), {}});
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
  add_field(type, field, count, values_per_particle, {Column::owning(std::move(floats)), {}});
  has_double_positions_ = has_double_positions_ || is_position;
}

template <typename Whole>
void ArraySnapshot::add_whole(int type, const std::string& field, const Whole* values,
                              std::uint64_t count) {
  check(type, field, 1, values, count);
  std::vector<float> floats(count);
  std::transform(values, values + count, floats.begin(),
                 [](Whole value) { return static_cast<float>(value); });
  add_field(type, field, count, 1, {Column::owning(std::move(floats)), {values, values + count}});
}

void ArraySnapshot::set_field(int type, const std::string& field, const std::int64_t* values,
                              std::uint64_t count) {
  add_whole(type, field, values, count);
}

void ArraySnapshot::set_field(int type, const std::string& field, const std::uint64_t* values,
                              std::uint64_t count) {
  add_whole(type, field, values, count);
}

void ArraySnapshot::set_unit(int type, const std::string& field, const std::string& unit) {
  check_type(type, fmt::format("the unit of field {}", field));
  const ParticleTypeInfo* const known = info_.find_type(type);
  ParticleTypeInfo info = known == nullptr ? empty_type(type) : *known;
  const auto found = std::find_if(info.fields.begin(), info.fields.end(),
                                  [&](const FieldInfo& f) { return f.file_name == field; });
  if (found == info.fields.end()) {
    throw UsageError(
        fmt::format("the unit of field {} of type {}: there is no such field, expected one that "
                    "has been set; set the field first",
                    field, type));
  }
  found->unit = unit;
  changed();
  replace(std::move(info));
}

void ArraySnapshot::set_mass(int type, double mass) {
  check_type(type, "a mass");
  if (!std::isfinite(mass) || mass < 0) {
    throw UsageError(fmt::format("the mass of type {}: {}, expected a number >= 0", type, mass));
  }
  const ParticleTypeInfo* const known = info_.find_type(type);
  ParticleTypeInfo info = known == nullptr ? empty_type(type) : *known;
  info.table_mass = mass;
  changed();
  replace(std::move(info));
}

void ArraySnapshot::changed() const {
  memory().forget_own();
}

void ArraySnapshot::clear(int type) {
  check_type(type, "to be cleared");
  changed();
  info_.types.erase(std::remove_if(info_.types.begin(), info_.types.end(),
                                   [type](const ParticleTypeInfo& t) { return t.type == type; }),
                    info_.types.end());
  for (auto values = values_.begin(); values != values_.end();)
    values = values->first.first == type ? values_.erase(values) : std::next(values);
}

void ArraySnapshot::set_box_size(const BoxSides& sides) {
  const bool is_none = sides == BoxSides(0);
  if (!is_none && !sides.are_lengths()) {
    throw UsageError(
        fmt::format("the box size: {}, expected the side of a periodic box, one for each axis, or "
                    "0 for none",
                    sides.text()));
  }
  changed();
  info_.box_size = is_none ? std::nullopt : std::optional(sides);
}

void ArraySnapshot::set_time(double time) {
  changed();
  info_.time = time;
}

void ArraySnapshot::set_scale_factor(double scale_factor) {
  if (!std::isfinite(scale_factor) || !(scale_factor > 0)) {
    throw UsageError(
        fmt::format("the scale factor: {}, expected a finite number > 0", scale_factor));
  }
  changed();
  info_.redshift = 1 / scale_factor - 1;
}

void ArraySnapshot::set_position_origin(const Vec3& origin) {
  if (has_double_positions_) {
    throw UsageError(
        "the origin is set after positions that are stored relative to it; set it "
        "first");
  }
  changed();
  origin_ = origin;
}

Column ArraySnapshot::read(int type, const std::string& field) const {
  const FieldInfo& info = require_field(info_, type, field);
  return values_.at({type, info.file_name}).column;
}

std::vector<std::uint64_t> ArraySnapshot::read_integers(int type, const std::string& field) const {
  const FieldInfo& info = require_field(info_, type, field);
  const std::vector<std::uint64_t>& whole = values_.at({type, info.file_name}).whole;
  return whole.empty() ? Snapshot::read_integers(type, field) : whole;
}

}  // namespace splotchcl
