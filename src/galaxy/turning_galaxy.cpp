#include "splotchcl/turning_galaxy.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "formats/hdf5/gadget_hdf5_writer.h"
#include "galaxy/disk_types.h"
#include "galaxy/vector_at.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

void put(std::vector<float>& values, std::size_t i, const Vec3& vector) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    values[3 * i + axis] = static_cast<float>(vector.a[axis]);
}

class TurnedSnapshot : public Snapshot {
 public:
  TurnedSnapshot(std::shared_ptr<const Snapshot> galaxy, TurningSettings settings, double myr)
      : galaxy_(std::move(galaxy)),
        settings_(std::move(settings)),
        info_(galaxy_->info()),
        myr_(myr) {
    info_.time = myr;
    info_.has_positions_of_files = false;
    share_lasting_memory_of(*galaxy_);
  }

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override {
    const std::string& name = require_field(info_, type, field).name;
    if (name == "position") return turned(type).position;
    if (name == "velocity") return turned(type).velocity;
    return galaxy_->read(type, field);
  }
  std::vector<std::uint64_t> read_ids(int type) const override { return galaxy_->read_ids(type); }

 private:
  struct Turned {
    Column position, velocity;
  };

  const Turned& turned(int type) const {
    const auto found = turned_.find(type);
    if (found != turned_.end()) return found->second;
    return turned_[type] = turn(type);
  }

  Turned turn(int type) const {
    const Column position = galaxy_->read(type, "position");
    const Column velocity = galaxy_->read(type, "velocity");
    const Column axes = galaxy_->read(type, "OrbitAxis");
    const Column radii = galaxy_->read(type, "OrbitRadius");
    const Vec3 origin = galaxy_->position_origin();
    std::optional<double> pattern;
    if (settings_.pattern_speed && is_disk_type(type))
      pattern = *settings_.pattern_speed / myr_per_kpc_s_km;
    std::vector<float> places(position.size()), speeds(position.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const OrbitState start = {origin + vector_at(position, i), vector_at(velocity, i)};
      const Vec3 axis = vector_at(axes, i);
      const double angular_speed =
          pattern           ? *pattern
          : settings_.curve ? settings_.curve->angular_speed(static_cast<double>(radii[i]))
                            : shown_angular_speed(start, axis);
      const OrbitState now = move_on_orbit(start, axis, angular_speed, myr_, settings_);
      put(places, i, now.position);
      put(speeds, i, now.velocity);
    }
    return {Column::owning(std::move(places)), Column::owning(std::move(speeds))};
  }

  std::shared_ptr<const Snapshot> galaxy_;
  TurningSettings settings_;
  SnapshotInfo info_;
  double myr_;
  mutable std::map<int, Turned> turned_;
};

}  // namespace

void check_orbits(const Snapshot& galaxy) {
  for (const ParticleTypeInfo& type : galaxy.info().types) {
    for (const char* const name : {"velocity", "OrbitAxis", "OrbitRadius"}) {
      if (find_field(type, name) != nullptr) continue;
      throw DataError(
          fmt::format("{}: particles of type {} have no {}, expected a galaxy with orbits; make "
                      "one with splotchcl galaxy",
                      galaxy.info().files.front().string(), type.type, name));
    }
  }
}

double shown_angular_speed(const OrbitState& state, const Vec3& axis) {
  const Vec3 lever = boost::qvm::cross(axis, state.position);
  const double square = boost::qvm::dot(lever, lever);
  return square > 0 ? boost::qvm::dot(state.velocity, lever) / square / myr_per_kpc_s_km : 0;
}

TurningGalaxy::TurningGalaxy(std::shared_ptr<const Snapshot> galaxy, TurningSettings settings)
    : galaxy_(std::move(galaxy)), settings_(std::move(settings)) {
  if (!(settings_.step_myr > 0) || !std::isfinite(settings_.step_myr)) {
    throw UsageError(
        fmt::format("a step is {} Myr long, expected a finite number > 0", settings_.step_myr));
  }
  if (settings_.pattern_speed &&
      (!(*settings_.pattern_speed > 0) || !std::isfinite(*settings_.pattern_speed))) {
    throw UsageError(
        fmt::format("the pattern's speed is {} km/s/kpc, expected a finite number > 0; which way "
                    "a galaxy turns is said when it is made",
                    *settings_.pattern_speed));
  }
  check_orbits(*galaxy_);
}

std::shared_ptr<const Snapshot> TurningGalaxy::at(double myr) const {
  if (!(myr >= 0) || !std::isfinite(myr)) {
    throw UsageError(fmt::format("a galaxy is wanted after {} Myr, expected a number >= 0", myr));
  }
  return std::make_shared<TurnedSnapshot>(galaxy_, settings_, myr);
}

std::optional<std::string> turning_warning(double myr, std::optional<double> hold_myr) {
  if (!hold_myr || myr <= *hold_myr) return std::nullopt;
  return fmt::format(
      "{} Myr are more than the {:.0f} Myr for which the arms hold: the inner disk overtakes the "
      "outer, and the arms wind up; --pattern-speed turns them as a whole",
      myr, *hold_myr);
}

void write_galaxy_snapshot(const std::filesystem::path& path, const Snapshot& snapshot,
                           double myr) {
  WrittenSnapshot written;
  written.time = myr;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    WrittenType particles;
    particles.type = type.type;
    particles.count = type.count;
    for (const FieldInfo& field : type.fields) {
      if (field.name == "id") continue;
      particles.fields.push_back(
          {field.file_name, field.values_per_particle, snapshot.read(type.type, field.file_name)});
    }
    if (find_field(type, "id") != nullptr) particles.ids = snapshot.read_ids(type.type);
    written.types.push_back(std::move(particles));
  }
  write_gadget_hdf5(path, written);
}

}  // namespace splotchcl
