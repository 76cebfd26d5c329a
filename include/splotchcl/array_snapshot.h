#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// A simulation's own arrays as a snapshot, so that load_frame and draw_pictures take them in
// place of a file. Field names are those of files: position, mass, density, internal_energy,
// smoothing_length, Coordinates, HSML, ... or any other that a scene asks for. A type needs
// "position"; what else it needs follows from the scene.
class ArraySnapshot : public Snapshot {
 public:
  // Empty. The name stands for a file's in messages.
  explicit ArraySnapshot(const std::string& name_for_messages = "arrays");

  // `count` particles, 1 or 3 values for each, x y z of one particle after those of another.
  // Floats are borrowed: they stay the caller's and must outlive the snapshot. A simulation sets
  // its fields once, and calls changed() before the next picture. Doubles are copied as floats,
  // positions relative to the origin. A field that is set again replaces the earlier one.
  // Throws UsageError, and changes nothing, for a type outside 0 to 31, for other numbers of
  // values, for an array that is not aligned, for more particles than memory can hold, and for a
  // count that differs from that of the type's other fields.
  void set_field(int type, const std::string& field, const float* values, std::uint64_t count,
                 int values_per_particle = 1);
  void set_field(int type, const std::string& field, const double* values, std::uint64_t count,
                 int values_per_particle = 1);
  // One whole number for each, copied: conditions, ids and halo ids have it exact, all else as a
  // float.
  void set_field(int type, const std::string& field, const std::int64_t* values,
                 std::uint64_t count);
  void set_field(int type, const std::string& field, const std::uint64_t* values,
                 std::uint64_t count);
  // Floats that `owner` keeps where they are. It is kept as long as the snapshot or a column that
  // was read of it has them, and may be let go by any thread that uses one.
  void set_field(int type, const std::string& field, const float* values, std::uint64_t count,
                 int values_per_particle, std::shared_ptr<const void> owner);
  // What a field's values are in, as files name units: "kpc", "g/cm^3". Setting the field again
  // forgets it. Throws UsageError for a field that has not been set.
  void set_unit(int type, const std::string& field, const std::string& unit);
  // The same mass for all of a type, in the unit that a field "mass" would have. Throws UsageError
  // for a type outside 0 to 31, and for what is no finite number >= 0.
  void set_mass(int type, double mass);
  // What the arrays hold has changed: nothing that was found from it is used again.
  void changed() const;
  // Leaves a type's fields out, so that its count may change. Throws UsageError for a type outside
  // 0 to 31.
  void clear(int type);

  // The sides of a periodic box, in the unit of positions; all 0: there is none. Throws UsageError
  // for what is no finite number >= 0, and for some sides of 0.
  void set_box_size(const BoxSides& sides);
  void set_time(double time);  // in the simulation's unit, for texts in pictures
  // What `a` stands for in the units of fields: comoving lengths of "Mpc a" are a times as long in
  // Mpc. Throws UsageError for what is no finite number > 0.
  void set_scale_factor(double scale_factor);
  // What positions are relative to, in their unit: floats are taken as offsets from it, doubles
  // as positions from which it is subtracted. Throws UsageError when double positions are set
  // already.
  void set_position_origin(const Vec3& origin);

  const SnapshotInfo& info() const override { return info_; }
  // Throws DataError for a type or a field that has not been set.
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  Vec3 position_origin() const override { return origin_; }

 private:
  struct Values {
    Column column;
    std::vector<std::uint64_t> whole;  // the same numbers, where they were given as whole ones
  };
  void replace(ParticleTypeInfo info);
  void add_field(int type, const std::string& field, std::uint64_t count, int values_per_particle,
                 Values values);
  template <typename Whole>
  void add_whole(int type, const std::string& field, const Whole* values, std::uint64_t count);

  SnapshotInfo info_;
  std::map<std::pair<int, std::string>, Values> values_;  // by type and the caller's name
  Vec3 origin_ = {{0, 0, 0}};
  bool has_double_positions_ = false;
};

}  // namespace splotchcl
