#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sequence/interpolated_snapshot.h"
#include "sequence/type_path.h"
#include "snapshot/memory_snapshot.h"

namespace splotchcl::test {

// A snapshot in memory with ids, a time and a cosmology.
class MovingSnapshot : public Snapshot {
 public:
  explicit MovingSnapshot(double time) { info_.time = time; }

  MovingSnapshot& ids(int type, std::vector<std::uint64_t> ids) {
    ids_[type] = std::move(ids);
    return *this;
  }
  MovingSnapshot& field(int type, const std::string& name, std::vector<float> values,
                        int values_per_particle = 1) {
    memory_.add(type, name, std::move(values), values_per_particle);
    return *this;
  }
  MovingSnapshot& positions(int type, std::vector<float> values) {
    return field(type, "position", std::move(values), 3);
  }
  MovingSnapshot& velocities(int type, std::vector<float> values) {
    return field(type, "velocity", std::move(values), 3);
  }
  MovingSnapshot& box(const BoxSides& sides) {
    memory_.set_box_size(sides);
    return *this;
  }
  MovingSnapshot& origin(const Vec3& origin) {
    memory_.set_origin(origin);
    return *this;
  }
  MovingSnapshot& cosmology(const Cosmology& cosmology) {
    cosmology_ = cosmology;
    return *this;
  }
  MovingSnapshot& velocity_doubt(const std::string& doubt) {
    doubt_ = doubt;
    return *this;
  }

  // Done: takes what was said.
  std::shared_ptr<const SequenceMember> make() {
    const double time = info_.time;
    info_ = memory_.info();
    info_.time = time;
    info_.cosmology = cosmology_;
    info_.velocity_doubt = doubt_;
    return std::make_shared<SequenceMember>(std::make_unique<MovingSnapshot>(*this));
  }

  const SnapshotInfo& info() const override { return info_; }
  Vec3 position_origin() const override { return memory_.position_origin(); }
  Column read(int type, const std::string& field) const override {
    return memory_.read(type, field);
  }
  std::vector<std::uint64_t> read_ids(int type) const override { return ids_.at(type); }

 private:
  MemorySnapshot memory_;
  SnapshotInfo info_;
  std::map<int, std::vector<std::uint64_t>> ids_;
  std::optional<Cosmology> cosmology_;
  std::string doubt_;
};

inline SequenceSettings with(Interpolation interpolation) {
  SequenceSettings settings;
  settings.interpolation = interpolation;
  return settings;
}

// One type, 0, at a fraction of the way.
inline InterpolatedSnapshot between(const std::shared_ptr<const SequenceMember>& first,
                                    const std::shared_ptr<const SequenceMember>& second,
                                    double fraction,
                                    Interpolation interpolation = Interpolation::linear) {
  return InterpolatedSnapshot(make_pair(first, second, with(interpolation)), fraction);
}

inline std::vector<float> values(const Snapshot& snapshot, const std::string& field, int type = 0) {
  const Column column = snapshot.read(type, field);
  const ParticleTypeInfo& info = require_type(snapshot.info(), type);
  const FieldInfo& described = require_field(snapshot.info(), type, field);
  std::vector<float> values;
  const std::size_t size = info.count * static_cast<std::size_t>(described.values_per_particle);
  for (std::size_t i = 0; i < size; ++i)
    values.push_back(column[i]);
  return values;
}

}  // namespace splotchcl::test
