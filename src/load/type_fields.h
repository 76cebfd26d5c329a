#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formula/formula_values.h"
#include "load/missing_sizes.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The fields of all particles of one type: those of the file, and what follows from them
// (docs/scene.md, Fields). What had to be computed stays in the snapshot's memory.
class TypeFields {
 public:
  // `label` begins messages; `note` takes what the user should know. `center` is where
  // `radius` is measured from.
  TypeFields(const Snapshot& snapshot, const ParticleTypeInfo& type, std::string label,
             const Vec3& center, std::function<void(const std::string&)> note,
             MissingSizes sizes = {});

  const ParticleTypeInfo& info() const { return *type_; }
  std::size_t count() const { return static_cast<std::size_t>(type_->count); }

  // One value per particle; of a vector field its length; of what is no field's name the values of
  // the formula that it is. Throws UsageError when the type has no such field: `key` is the scene's
  // that asked for it.
  Column scalars(const std::string& field, const std::string& key) const;
  // Three values per particle.
  Column vectors(const std::string& field, const std::string& key) const;
  Column positions() const;
  Column masses() const;
  // Mass over density, in so many of the cube of the positions' unit.
  Column volumes(const std::string& key, double unit) const;
  // The file's; else from densities or neighbours.
  Column smoothing_lengths() const;
  std::vector<std::uint64_t> ids() const;

  // What formulas are made of (derived_fields.h): fields alone.
  bool has_plain(const std::string& field) const;
  Column plain_scalars(const std::string& field, const std::string& key) const;
  FieldValues plain_values(const std::string& field, const std::string& key) const;
  // Of identifiers, the type's own or those of haloes and others; nothing for other fields.
  std::optional<WholeNumbers> whole_numbers(const std::string& field, bool are_large) const;
  const SnapshotInfo& snapshot_info() const { return snapshot_->info(); }
  // "component gas: color.field", which begins messages.
  std::string what(const std::string& key) const { return label_ + ": " + key; }
  [[noreturn]] void refuse_field(const std::string& field, const std::string& key) const;

  // Refuse what scalars() and vectors() would, and read nothing.
  void check_scalars(const std::string& field, const std::string& key) const;
  void check_vectors(const std::string& field, const std::string& key) const;

 private:
  struct Made {
    Column column;
    std::vector<std::string> notes;
  };
  Column remembered(const std::string& what, const std::function<Column()>& make) const;
  Column field_column(const FieldInfo& field) const;
  const FieldInfo& require_vectors(const std::string& field, const std::string& key) const;
  std::optional<std::function<Column()>> find_derived(const std::string& field,
                                                      const std::string& key) const;
  Column derived_temperatures(const std::string& key) const;
  Column densities() const;
  Column find_lengths() const;
  std::optional<Column> own_lengths() const;
  bool reach_to_neighbors() const;  // smoothing lengths
  bool has_density_and_mass() const;
  std::optional<Column> lengths_from_volumes(std::string& reason) const;
  std::optional<double> unit_of_densities() const;
  std::optional<double> unit_of_volumes() const;
  std::optional<BoxSides> periodic_box() const;
  bool streams() const;
  Column formula_column(const Formula& formula, const std::string& key) const;
  void say(const std::string& text) const;
  [[noreturn]] void refuse_width(const FieldInfo& info, const std::string& field,
                                 const std::string& key, const char* expected) const;
  std::string file() const;

  const Snapshot* snapshot_;
  const ParticleTypeInfo* type_;
  std::string label_;
  Vec3 center_;
  std::function<void(const std::string&)> note_;
  MissingSizes sizes_;
  mutable std::vector<std::string> said_;
};

}  // namespace splotchcl
