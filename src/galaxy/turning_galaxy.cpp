#include "splotchcl/turning_galaxy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "formats/hdf5/gadget_hdf5_writer.h"
#include "galaxy/matter.h"
#include "scene/constants.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot.h"

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
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override {
    return galaxy_->read_integers(type, field);
  }

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

namespace {

using boost::qvm::cross;
using boost::qvm::dot;

struct Turn {
  double angle = 0;
  double stretch = 1;  // of the distance from the axis
};

Turn first_order_step(double angle) {
  return {std::atan(angle), std::sqrt(1 + angle * angle)};
}

Turn turn_of(double angular_speed, double myr, const TurningSettings& settings) {
  if (settings.integrator == OrbitIntegrator::exact) return {angular_speed * myr, 1};
  const double steps = std::floor(myr / settings.step_myr);
  const Turn step = first_order_step(angular_speed * settings.step_myr);
  const Turn rest = first_order_step(angular_speed * (myr - steps * settings.step_myr));
  return {steps * step.angle + rest.angle, std::pow(step.stretch, steps) * rest.stretch};
}

Vec3 turned(const Vec3& vector, const Vec3& axis, double angle, double stretch) {
  const Vec3 along = axis * dot(axis, vector);
  const Vec3 across = vector - along;
  return along + (across * std::cos(angle) + cross(axis, across) * std::sin(angle)) * stretch;
}

}  // namespace

OrbitState move_on_orbit(const OrbitState& start, const Vec3& axis, double angular_speed,
                         double myr, const TurningSettings& settings) {
  const Turn turn = turn_of(angular_speed, myr, settings);
  return {turned(start.position, axis, turn.angle, turn.stretch),
          turned(start.velocity, axis, turn.angle, 1)};
}

namespace {

struct DiskMatter {
  double radius = 0, light = 0, angular_speed = 0;  // kpc, any unit, radians per Myr
};

void add_matter(std::vector<DiskMatter>& all, const Snapshot& galaxy, int type,
                const TurningSettings& settings) {
  const Column position = galaxy.read(type, "position"), velocity = galaxy.read(type, "velocity");
  const Column radius = galaxy.read(type, "OrbitRadius"), axis = galaxy.read(type, "OrbitAxis");
  const Column mass = galaxy.read(type, "mass"), color = galaxy.read(type, "Color");
  for (std::size_t i = 0; i < radius.size(); ++i) {
    DiskMatter matter;
    matter.radius = static_cast<double>(radius[i]);
    matter.light = static_cast<double>(mass[i]) *
                   static_cast<double>(color[3 * i] + color[3 * i + 1] + color[3 * i + 2]);
    matter.angular_speed =
        settings.curve ? settings.curve->angular_speed(matter.radius)
                       : shown_angular_speed({vector_at(position, i), vector_at(velocity, i)},
                                             vector_at(axis, i));
    all.push_back(matter);
  }
}

// Around a radius.
double mean_angular_speed(const std::vector<DiskMatter>& all, double radius) {
  double sum = 0, weight = 0;
  for (const DiskMatter& matter : all) {
    if (std::abs(matter.radius / radius - 1) > 0.1) continue;
    sum += matter.light * matter.angular_speed;
    weight += matter.light;
  }
  return weight > 0 ? sum / weight : 0;
}

// That holds half of the light.
double half_light_radius(std::vector<DiskMatter> all) {
  std::sort(all.begin(), all.end(),
            [](const DiskMatter& a, const DiskMatter& b) { return a.radius < b.radius; });
  double total = 0, inside = 0;
  for (const DiskMatter& matter : all)
    total += matter.light;
  for (const DiskMatter& matter : all) {
    inside += matter.light;
    if (inside >= total / 2) return matter.radius;
  }
  return 0;
}

}  // namespace

std::optional<double> arms_hold_myr(const Snapshot& galaxy, const TurningSettings& settings) {
  if (settings.pattern_speed) return std::nullopt;
  std::vector<DiskMatter> all;
  for (const ParticleTypeInfo& type : galaxy.info().types) {
    const bool shines = find_field(type, "Color") != nullptr && has_masses(type);
    if (is_disk_type(type.type) && shines) add_matter(all, galaxy, type.type, settings);
  }
  const double radius = half_light_radius(all);
  if (!(radius > 0)) return std::nullopt;
  constexpr double ratio = 1.25;
  const double shear =
      std::abs(mean_angular_speed(all, radius * ratio) - mean_angular_speed(all, radius / ratio)) /
      (2 * std::log(ratio));
  constexpr double pitch = 20 * pi / 180;
  constexpr double least_shear = 1e-3;  // of the angular speed: less is rounding
  const bool shears = shear > least_shear * mean_angular_speed(all, radius);
  return shears ? std::optional(1 / (std::tan(pitch) * shear)) : std::nullopt;
}

}  // namespace splotchcl
