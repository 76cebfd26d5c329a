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

std::string text_of(const std::vector<py::ssize_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

// 1 or 3 values per particle.
int values_per_particle(const std::string& field, const py::buffer_info& info) {
  if (info.ndim == 1) return 1;
  if (info.ndim == 2 && (info.shape[1] == 1 || info.shape[1] == 3)) {
    return static_cast<int>(info.shape[1]);
  }
  throw UsageError("field " + field + ": an array of shape " + text_of(info.shape) +
                   ", expected (N,) or (N, 3) for N particles");
}

// A kind of number in the machine's endianness, as struct writes it: "f", "=f", "<f".
bool is_native(const std::string& format, char kind) {
  constexpr char endianness = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? '<' : '>';
  if (format.size() == 1) return format[0] == kind;
  const bool is_here = format[0] == endianness || format[0] == '=' || format[0] == '@';
  return format.size() == 2 && format[1] == kind && is_here;
}

bool is_contiguous(const py::buffer_info& info) {
  py::ssize_t step = info.itemsize;
  for (py::ssize_t axis = info.ndim; axis-- > 0;) {
    const auto i = static_cast<std::size_t>(axis);
    if (info.shape[i] > 1 && info.strides[i] != step) return false;
    step *= info.shape[i];
  }
  return true;
}

// Lets go of the array with Python's lock, which whoever has its last column may lack.
std::shared_ptr<const py::buffer_info> shared(py::buffer_info info) {
  const auto let_go = [](const py::buffer_info* last) {
    const py::gil_scoped_acquire lock;
    delete last;
  };
  return {new py::buffer_info(std::move(info)), let_go};
}

template <typename Change>
void change(Turn& turn, Change&& work) {
  without_python([&] {
    const std::lock_guard<Turn> mine(turn);
    work();
  });
}

}  // namespace

ParticleArrays::ParticleArrays() : ParticleArrays(std::make_shared<ArraySnapshot>()) {}

void ParticleArrays::set_field(int type, const std::string& field, const py::buffer& values,
                               const std::string& unit) {
  const auto info = shared(values.request());
  const int width = values_per_particle(field, *info);
  const auto count = static_cast<std::uint64_t>(info->shape[0]);
  const bool is_float = is_native(info->format, 'f');
  const bool is_double = is_native(info->format, 'd');
  if (!is_contiguous(*info) || (!is_float && !is_double)) {
    throw UsageError("field " + field + ": values of the kind '" + info->format +
                     "', expected floats or doubles in C order and the machine's endianness");
  }
  change(turn(), [&] {
    if (is_float) {
      arrays_->set_field(type, field, static_cast<const float*>(info->ptr), count, width, info);
    } else {
      arrays_->set_field(type, field, static_cast<const double*>(info->ptr), count, width);
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
