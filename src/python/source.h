#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "python/interface/casts.h"
#include "python/interface/functions.h"
#include "splotchcl/array_snapshot.h"

namespace splotchcl::python {

// Threads of Python take turns at an object that is made for one at a time. Locked only while
// Python's own lock is free: who waits here holding it would keep the other from going on.
class Turn {
 public:
  // Throws UsageError for the thread whose turn it is already: a progress callable must not use
  // what calls it.
  void lock();
  void unlock();

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_ = std::thread::id();
};

// What is drawn: a snapshot, and whose turn it is to read it.
class Source {
 public:
  explicit Source(std::shared_ptr<const Snapshot> snapshot) : snapshot_(std::move(snapshot)) {}
  virtual ~Source() = default;

  const Snapshot& snapshot() const { return *snapshot_; }
  // To be called before the snapshot is used, with the turn taken.
  virtual void refresh() const {}
  Turn& turn() const { return turn_; }
  // What `look` finds in the snapshot, while nobody sets its arrays. To be called without Python's
  // lock.
  template <typename Look>
  auto in_turn(Look&& look) const {
    const std::lock_guard<Turn> mine(turn_);
    return look(*snapshot_);
  }

 private:
  std::shared_ptr<const Snapshot> snapshot_;
  mutable Turn turn_;
};

// Arrays of Python as a snapshot. Each is kept as long as a column has it, so that neither `del`,
// nor a resize, nor another in its place takes away what is drawn or what was read.
class ParticleArrays : public Source {
 public:
  ParticleArrays();

  // Floats are borrowed; other numbers are copied. The unit is as files name units; empty: not
  // known.
  void set_field(int type, const std::string& field, const py::ArrayOfNumbers& values,
                 const std::string& unit);
  void set_mass(int type, double mass);
  void clear(int type);
  void set_box_size(const Vec3& sides);
  void set_time(double time);
  void set_scale_factor(double scale_factor);
  void set_origin(const Vec3& origin);
  // The arrays may hold other values than when they were drawn last.
  void refresh() const override { arrays_->changed(); }

 private:
  explicit ParticleArrays(const std::shared_ptr<ArraySnapshot>& arrays)
      : Source(arrays), arrays_(arrays) {}

  std::shared_ptr<ArraySnapshot> arrays_;
};

}  // namespace splotchcl::python

template <>
struct splotchcl::py::RootOf<splotchcl::python::ParticleArrays> {
  using Type = python::Source;
};

namespace splotchcl::python {

// Adds Source, Particles and what opens snapshots to the module.
void bind_sources(py::Module& module);

}  // namespace splotchcl::python
