#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// Reads the fields of one component: the particle types that it draws, one after the
// other. Messages name the component and the scene's key that asked for the field.
class ComponentFields {
 public:
  // Throws UsageError when the snapshot has none of the component's types.
  ComponentFields(const Component& component, const Snapshot& snapshot,
                  std::vector<std::string>& notes);

  std::size_t count() const;  // particles of all types together
  Column positions() const;
  // One value per particle; of a vector field its length. Throws UsageError when a type
  // does not have the field.
  Column scalars(const std::string& field, const std::string& key) const;
  // Three values per particle, of a vector field.
  Column vectors(const std::string& field, const std::string& key) const;
  bool masses_are_known() const;
  Column masses() const;
  // h as the scene says: a fixed size, a field of the file, or, for "smoothing_length"
  // where the file has none, found from the particles themselves.
  Column smoothing_lengths() const;

  // Adds "component NAME: text" to the notes.
  void note(const std::string& text) const;
  std::string label() const;  // "component NAME" for messages

 private:
  Column scalars_of_type(const ParticleTypeInfo& type, const std::string& field,
                         const std::string& key) const;
  Column masses_of_type(const ParticleTypeInfo& type) const;
  Column densities_of_type(const ParticleTypeInfo& type) const;
  Column smoothing_lengths_of_type(const ParticleTypeInfo& type) const;
  Column find_lengths(const ParticleTypeInfo& type) const;
  std::optional<double> periodic_box(const Column& position) const;
  [[noreturn]] void refuse_types() const;
  [[noreturn]] void refuse_field(const ParticleTypeInfo& type, const std::string& field,
                                 const std::string& key) const;

  const Component& component_;
  const Snapshot& snapshot_;
  std::vector<std::string>& notes_;
  std::vector<const ParticleTypeInfo*> types_;
  // Those that had to be found, which takes a while: by type.
  mutable std::map<int, Column> found_lengths_;
};

}  // namespace splotchcl
