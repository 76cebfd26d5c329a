#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "snapshot/field_names.h"
#include "splotchcl/snapshot.h"

namespace splotchcl::test {

// A snapshot that was never a file. It remembers what was read from it.
class MemorySnapshot : public Snapshot {
 public:
  MemorySnapshot() {
    info_.format = "memory";
    info_.files = {"memory"};
  }

  void add(int type, const std::string& field, std::vector<float> values,
           int values_per_particle = 1) {
    ParticleTypeInfo& particles = type_info(type);
    particles.count = values.size() / static_cast<std::size_t>(values_per_particle);
    FieldInfo info;
    info.name = field;
    info.file_name = field;
    info.values_per_particle = values_per_particle;
    particles.fields.push_back(info);
    columns_[{type, field}] = Column::owning(std::move(values));
  }
  void set_unit(int type, const std::string& field, const std::string& unit) {
    for (FieldInfo& info : type_info(type).fields) {
      if (info.name == field) info.unit = unit;
    }
  }
  void set_table_mass(int type, double mass) { type_info(type).table_mass = mass; }
  void set_cosmology(const Cosmology& cosmology) { info_.cosmology = cosmology; }
  void set_hubble_parameter(double h) { info_.hubble_parameter = h; }
  void set_box_size(const BoxSides& sides) { info_.box_size = sides; }
  void set_origin(const Vec3& origin) { origin_ = origin; }

  const std::vector<std::string>& fields_read() const { return fields_read_; }

  const SnapshotInfo& info() const override { return info_; }
  Vec3 position_origin() const override { return origin_; }
  Column read(int type, const std::string& field) const override {
    const std::string& name = require_field(info_, type, field).name;
    fields_read_.push_back(name);
    return columns_.at({type, name});
  }

 private:
  ParticleTypeInfo& type_info(int type) {
    auto place = std::find_if(info_.types.begin(), info_.types.end(),
                              [type](const ParticleTypeInfo& t) { return t.type >= type; });
    if (place == info_.types.end() || place->type != type) {
      ParticleTypeInfo added;
      added.type = type;
      place = info_.types.insert(place, added);
    }
    return *place;
  }

  SnapshotInfo info_;
  std::map<std::pair<int, std::string>, Column> columns_;
  Vec3 origin_ = {{0, 0, 0}};
  mutable std::vector<std::string> fields_read_;
};

}  // namespace splotchcl::test
