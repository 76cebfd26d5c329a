#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
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

// A dataset of rows, one row per particle, or a part of each row: a member of its records, a
// column.
struct Hdf5Dataset {
  enum class Kind { integer, real, records, other };
  std::string path;                 // in the file
  std::vector<std::string> member;  // from the records to what is in them; empty: the whole row
  std::vector<hsize_t> shape;       // that of a member that is an array follows the dataset's
  Kind kind = Kind::other;
  std::size_t bytes_per_value = 0;
  bool is_signed = false;
  bool has_axes_first = false;          // of shape (3, N): a row is what is in one column
  std::optional<std::uint64_t> column;  // the only one that counts

  std::string label() const;
  // The path, and what of it.
  std::string name() const;
  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
  bool is_as_stored() const { return member.empty() && !has_axes_first && !column; }
  std::uint64_t rows() const;
  std::uint64_t values_per_row() const { return column ? 1 : stored_values_per_row(); }
  std::uint64_t stored_values_per_row() const;
  bool is_double() const { return kind == Kind::real && bytes_per_value > 4; }
  // Whether single precision has every value that it may hold.
  bool is_single_precision() const {
    return kind == Kind::real ? !is_double() : bytes_per_value <= 2;
  }
};

// Before any other call of HDF5; as often as wanted. Throws DataError.
void start_hdf5();

// While one lives, HDF5 does not print its errors: ours say what is wrong.
class Hdf5Silence {
 public:
  Hdf5Silence();
  ~Hdf5Silence();
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  H5E_auto2_t printer_ = nullptr;
  void* data_ = nullptr;
};

// Where values lie on the disk.
struct Hdf5Place {
  std::filesystem::path file;  // another than the one that was opened where a link leads there
  std::uint64_t offset = 0;
};

// An HDF5 file opened for reading. Every member throws DataError when HDF5 fails, with
// HDF5's own reason. HDF5 is not thread-safe: use from one thread at a time.
class Hdf5File {
 public:
  explicit Hdf5File(const std::filesystem::path& path);

  static bool has_signature(const std::byte* data, std::uint64_t size);

  const std::filesystem::path& path() const { return path_; }
  // Where what has been asked for led, out of the file.
  const Hdf5Links& links() const { return *links_; }
  bool has(const std::string& object) const;
  // Whether its name is another one for something in the file.
  bool is_soft_link(const std::string& object) const;
  std::vector<std::string> groups(const std::string& group) const;    // names, sorted
  std::vector<Hdf5Dataset> datasets(const std::string& group) const;  // sorted by name
  std::vector<std::string> dataset_names(const std::string& group) const;
  Hdf5Dataset dataset(const std::string& path) const;
  // What is in the records of a dataset, and in records in these; nothing where it has none.
  std::vector<Hdf5Dataset> members(const Hdf5Dataset& records) const;
  // The lines of a dataset of texts of one length; nothing where it is none.
  std::vector<std::string> lines(const std::string& path) const;

  // A numeric attribute, scalar or array of any shape, also of texts that are numbers. None when it
  // is absent or other text.
  std::optional<std::vector<double>> numbers(const std::string& object,
                                             const std::string& attribute) const;
  std::optional<double> number(const std::string& object, const std::string& attribute) const;
  std::optional<std::string> text(const std::string& object, const std::string& attribute) const;

  // Refuses a dataset that the file does not hold completely, so that no memory is
  // claimed for values that are not there, and one that HDF5 cannot unpack here.
  void check_complete(const Hdf5Dataset& dataset) const { check_complete(dataset, 0); }

  // Rows [first, first + rows), converted by HDF5. `out` has rows * values_per_row places.
  void read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                 float* out) const;
  void read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                 double* out) const;
  // Whole numbers, exact; those below zero are taken modulo 2^64.
  void read_rows(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows,
                 std::uint64_t* out) const;

  // Rows to read at a time: a large piece of whole chunks.
  std::uint64_t rows_per_piece(const Hdf5Dataset& dataset) const;

  // Where the values lie, when they lie there in one piece as this machine's own floats.
  std::optional<Hdf5Place> find_native_floats(const Hdf5Dataset& dataset) const;

 private:
  using Attribute = Hdf5Handle<H5Aclose>;
  using Dataset = Hdf5Handle<H5Dclose>;
  std::vector<std::string> children(const std::string& group, H5I_type_t wanted) const;
  std::vector<std::string> texts(hid_t attribute) const;
  Attribute open_attribute(const std::string& object, const std::string& name) const;
  Dataset open_dataset(const std::string& path) const;
  // `depth`: how many virtual datasets it is a source of.
  void check_complete(const Hdf5Dataset& dataset, int depth) const;
  bool check_sources(const Hdf5Dataset& dataset, hid_t handle, hid_t properties, int depth) const;
  // `owner`: the file that the virtual dataset lies in.
  void check_source(const std::string& dataset, const std::filesystem::path& owner,
                    const std::filesystem::path& file, const std::string& source, int depth) const;
  void check_filters(const std::string& dataset, hid_t properties) const;
  void read(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows, hid_t type,
            void* out) const;
  template <class T>
  void read_parts(const Hdf5Dataset& dataset, std::uint64_t first, std::uint64_t rows, hid_t type,
                  T* out) const;
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail(const std::string& what, const std::string& reason) const;

  std::filesystem::path path_;
  std::unique_ptr<Hdf5Links> links_;  // where the rules find it
  Hdf5LinkRules rules_;
  Hdf5Handle<H5Fclose> file_;
};

}  // namespace splotchcl
