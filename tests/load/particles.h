#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "snapshot/memory_snapshot.h"
#include "splotchcl/error.h"
#include "splotchcl/generate.h"
#include "splotchcl/load.h"

namespace splotchcl::test {

// A snapshot in memory with identifiers.
class NumberedSnapshot : public MemorySnapshot {
 public:
  void number(int type, std::vector<std::uint64_t> ids) { ids_[type] = std::move(ids); }
  std::vector<std::uint64_t> read_ids(int type) const override {
    const auto found = ids_.find(type);
    return found == ids_.end() ? Snapshot::read_ids(type) : found->second;
  }

 private:
  std::map<int, std::vector<std::uint64_t>> ids_;
};

// Gas in a row along x, at 0, 1, 2, ..., with internal energies 1, 10, 100, ... and moving
// along y.
inline NumberedSnapshot gas_row(int count = 6) {
  NumberedSnapshot snapshot;
  std::vector<float> position, velocity, h, mass, energy;
  std::vector<std::uint64_t> ids;
  float power = 1;
  for (int i = 0; i < count; ++i, power *= 10) {
    position.insert(position.end(), {static_cast<float>(i), 0, 0});
    velocity.insert(velocity.end(), {0, static_cast<float>(2 * i), 0});
    h.push_back(static_cast<float>(i + 1) / 8);
    mass.push_back(static_cast<float>(i + 1));
    energy.push_back(power);
    // Neighbours in single precision, far apart from each other in truth.
    ids.push_back((1ull << 60) + static_cast<std::uint64_t>(i));
  }
  snapshot.add(0, "position", position, 3);
  snapshot.add(0, "velocity", velocity, 3);
  snapshot.add(0, "smoothing_length", h);
  snapshot.add(0, "mass", mass);
  snapshot.add(0, "internal_energy", energy);
  snapshot.number(0, ids);
  return snapshot;
}

inline void write_universe(const std::filesystem::path& path, std::size_t particles) {
  GenerateSettings settings;
  settings.particles = particles;
  write_gadget2(path, generate_universe(settings));
}

inline Component gas() {
  Component component;
  component.name = "gas";
  component.palette = "white";
  return component;
}

inline Scene scene_of(std::vector<Component> components) {
  Scene scene;
  scene.image.width = 64;
  scene.image.height = 48;
  Camera camera;
  camera.position = {{0, -20, 0}};
  camera.look_at = {{0, 0, 0}};
  camera.sky = {{0, 0, 1}};
  scene.camera = camera;
  scene.components = std::move(components);
  return scene;
}

inline Frame load(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  return load_frame(scene, snapshot, notes);
}

inline DrawnComponent load(const Component& component, const Snapshot& snapshot) {
  return load(scene_of({component}), snapshot).components.at(0);
}

inline std::vector<std::string> notes_of(const Component& component, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  load_frame(scene_of({component}), snapshot, notes);
  return notes;
}

inline std::string refusal(const Component& component, const Snapshot& snapshot) {
  try {
    load(component, snapshot);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// A column as far as its array goes.
inline std::vector<float> values(const Column& column) {
  return std::vector<float>(column.data(), column.data() + column.size());
}

}  // namespace splotchcl::test
