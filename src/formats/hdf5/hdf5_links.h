#pragma once

#include <hdf5.h>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

// Where a file's external links and virtual datasets lead.
struct Hdf5Links {
  std::set<std::filesystem::path> followed;
  std::set<std::string> refused;  // as the file spells them
  std::set<std::string> dead;     // in the file, and where they lead
};

// Adds a note for each place that links were not followed to, and for links that lead nowhere.
void note_refused(const Hdf5Links& links, std::vector<std::string>& notes);

// Properties with which HDF5 follows external links only to regular files in the folder of the file
// that has them, or below it: a file from anywhere shall not have others opened, or wait for a
// FIFO. What is found is added to `links`, which must stay where it is for as long.
class Hdf5LinkRules {
 public:
  explicit Hdf5LinkRules(Hdf5Links& links);

  hid_t of_links() const { return of_links_.id(); }
  hid_t of_groups() const { return of_groups_.id(); }
  hid_t of_datasets() const { return of_datasets_.id(); }

 private:
  Hdf5Handle<H5Pclose> of_links_, of_groups_, of_datasets_;
};

// A name of a source of a virtual dataset, by either of HDF5's functions for them.
std::string virtual_source_name(ssize_t (*get)(hid_t, std::size_t, char*, std::size_t),
                                hid_t properties, std::size_t source);

// Where HDF5 looks for a file that a virtual dataset names; a place that does not exist where it
// finds none.
std::filesystem::path find_virtual_source(const std::filesystem::path& virtual_file,
                                          const std::filesystem::path& name);

// The file that an open dataset lies in: another than the one that was opened where an external
// link leads there.
std::filesystem::path file_of_dataset(hid_t dataset);

// Before HDF5 asks how large a virtual dataset is, for which it may open all its files. Throws
// DataError for one that is no regular file.
void check_virtual_sources(hid_t dataset, Hdf5Links& links);

}  // namespace splotchcl
