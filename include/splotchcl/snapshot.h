#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/particles.h"
#include "splotchcl/periodic.h"

namespace splotchcl {

// Fields have canonical names: position, velocity, id, mass, internal_energy, density,
// smoothing_length, temperature, stellar_age, metallicity, ... A file's own label (U,
// HSML, InternalEnergy) finds the same field, in any case of letters.
struct FieldInfo {
  std::string name;             // canonical, or the file's own name where there is none
  std::string file_name;        // as the file spells it; empty: it follows from other fields
  int values_per_particle = 1;  // 1, or 3 for vectors
  std::string unit;             // empty when unknown
};

// The particles of one type, which all have the same fields.
struct ParticleTypeInfo {
  int type = 0;  // 0 gas, 1 halo, 2 disk, 3 bulge, 4 stars, 5 boundary
  std::uint64_t count = 0;
  std::optional<double> table_mass;  // the same mass for all, in the snapshot's unit
  std::vector<FieldInfo> fields;
  // How many particles of the file each stands for, where only a part of them is read.
  double particles_per_drawn = 1;
};

// A run in an expanding universe, with positions in comoving coordinates (docs/time.md).
struct Cosmology {
  double scale_factor = 1;  // a
  // 0: the file does not say.
  double omega_matter = 0;
  double omega_lambda = 0;
  double hubble_rate = 0;  // H0, in the file's unit of velocity over its unit of length
  // The peculiar velocity a dx/dt is the stored one times a^velocity_power.
  double velocity_power = 0.5;
};

// What is known of a snapshot before particles are read. Values are in its own units.
struct SnapshotInfo {
  std::string format;                        // "Gadget format 2, big-endian", ...
  std::vector<std::filesystem::path> files;  // at least one; of arrays in memory, their name
  // Files that it is read from as well: arrays beside it, what its datasets lead to.
  std::vector<std::filesystem::path> files_beside;
  // Follows from the names, lengths and times that all of these had when they were opened, so that
  // files that are written anew have another one. 0: there are no files.
  std::uint64_t files_mark = 0;
  double time = 0;
  std::optional<double> redshift;
  // Of the periodic box, as the file says, whether or not its particles lie in it; none: not
  // periodic, or unknown.
  std::optional<BoxSides> box_size;
  std::optional<double> hubble_parameter;  // h: H0 in units of 100 km/s/Mpc
  std::optional<Cosmology> cosmology;      // none: velocities are dx/dt, with t the time above
  // Why velocities cannot be taken for changes of the positions in time; empty: they can.
  std::string velocity_doubt;
  // False where particles are elsewhere than the files say, as those of a galaxy that has turned:
  // what is kept beside the files does not tell where they are.
  bool has_positions_of_files = true;
  std::vector<ParticleTypeInfo> types;  // those with particles, in increasing type
  std::vector<std::string> notes;       // oddities worth telling the user
  // Null for a type without particles.
  const ParticleTypeInfo* find_type(int type) const;
  // Whether all particles of the files are read.
  bool is_whole() const;
};

class LoadMemory;
class SpreadParticles;

// A snapshot that has been opened: its header is known, no particle has been read. What it
// holds does not change as long as it lives.
class Snapshot {
 public:
  virtual ~Snapshot() = default;
  virtual const SnapshotInfo& info() const = 0;

  // Values of one field of one type, single precision, in file order; 3 per particle
  // for vectors. Points into the mapped file where that is possible. Positions are
  // relative to position_origin(). Throws DataError.
  virtual Column read(int type, const std::string& field) const = 0;

  // The identifiers of one type's particles, exact, in file order. Throws DataError where
  // the type has none.
  virtual std::vector<std::uint64_t> read_ids(int type) const;

  // A field of whole numbers, exact, in file order: those below zero modulo 2^64. Throws
  // DataError where the field holds others.
  virtual std::vector<std::uint64_t> read_integers(int type, const std::string& field) const;

  // Where the i-th particle of a type is among all that the files have of it. Throws DataError
  // where the snapshot stands for no single one.
  virtual std::uint64_t place_in_file(int type, std::uint64_t i) const;

  // Zero where single precision holds all positions as they are stored; not for doubles and text.
  virtual Vec3 position_origin() const { return {{0, 0, 0}}; }

  // Not null where the particles are spread over ranks (spread_snapshot.h).
  virtual std::shared_ptr<SpreadParticles> spread() const { return nullptr; }
  // Of such a snapshot what this rank has, with its counts in info(); of others all.
  virtual const Snapshot& own_part() const { return *this; }

  // What decide and load have made of the snapshot and want again for the next frame of a film:
  // selections, derived fields, snapshots of single components. No part of the snapshot's
  // value; copies share it. Not for use from several threads at once.
  LoadMemory& memory() const;
  // For a snapshot that stands for another one, as at a time between two: the snapshots of
  // single components and what else is the same at every time.
  void share_lasting_memory_of(const Snapshot& other);

 private:
  mutable std::shared_ptr<LoadMemory> memory_;
};

}  // namespace splotchcl
