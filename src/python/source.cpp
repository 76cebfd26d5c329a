#include "python/source.h"

#include <mutex>
#include <utility>

#include "python/progress.h"
#include "splotchcl/error.h"

namespace splotchcl::python {

void Turn::lock() {
  if (owner_ == std::this_thread::get_id()) {
    throw UsageError(
        "a progress callable uses the renderer or the particles that call it, expected others; do "
        "it when the picture is drawn");
  }
  mutex_.lock();
  owner_ = std::this_thread::get_id();
}

void Turn::unlock() {
  owner_ = std::thread::id();
  mutex_.unlock();
}

namespace {

template <typename Change>
void change(Turn& turn, Change&& work) {
  without_python([&] {
    const std::lock_guard<Turn> mine(turn);
    work();
  });
}

}  // namespace

ParticleArrays::ParticleArrays() : ParticleArrays(std::make_shared<ArraySnapshot>()) {}

void ParticleArrays::set_field(int type, const std::string& field, const py::ArrayOfNumbers& values,
                               const std::string& unit) {
  change(turn(), [&] {
    if (values.is_double) {
      const auto* const doubles = static_cast<const double*>(values.first);
      arrays_->set_field(type, field, doubles, values.count, values.width);
    } else {
      const auto* const floats = static_cast<const float*>(values.first);
      arrays_->set_field(type, field, floats, values.count, values.width, values.owner);
    }
    arrays_->set_unit(type, field, unit);
  });
}

void ParticleArrays::set_mass(int type, double mass) {
  change(turn(), [&] { arrays_->set_mass(type, mass); });
}

void ParticleArrays::clear(int type) {
  change(turn(), [&] { arrays_->clear(type); });
}

void ParticleArrays::set_box_size(const Vec3& sides) {
  change(turn(), [&] { arrays_->set_box_size(BoxSides(sides)); });
}

void ParticleArrays::set_time(double time) {
  change(turn(), [&] { arrays_->set_time(time); });
}

void ParticleArrays::set_scale_factor(double scale_factor) {
  change(turn(), [&] { arrays_->set_scale_factor(scale_factor); });
}

void ParticleArrays::set_origin(const Vec3& origin) {
  change(turn(), [&] { arrays_->set_position_origin(origin); });
}

}  // namespace splotchcl::python
