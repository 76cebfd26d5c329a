#pragma once

#include <hdf5.h>

#include <utility>

namespace splotchcl {

// Closes an HDF5 identifier of the kind that `Close` is for.
template <herr_t (*Close)(hid_t)>
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    reset();
    id_ = std::exchange(other.id_, H5I_INVALID_HID);
    return *this;
  }
  hid_t id() const { return id_; }
  bool is_valid() const { return id_ >= 0; }
  // For who must know whether that went well.
  herr_t close() { return Close(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  void reset() {
    if (id_ >= 0) {
      // Nobody can do anything about it, and the library would have lines of its own.
      H5E_BEGIN_TRY {
        Close(id_);
      }
      H5E_END_TRY
    }
    id_ = H5I_INVALID_HID;
  }
  hid_t id_ = H5I_INVALID_HID;
};

}  // namespace splotchcl
