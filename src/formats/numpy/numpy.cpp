// NumPy: a single array (.npy), structured or of rows, or an archive of arrays (.npz), packed
// or not.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>

#include "formats/numpy/numpy_array.h"
#include "formats/snapshot_format.h"
#include "formats/table.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "snapshot/stated_numbers.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

// Rows of more numbers without names are taken for those of an image.
constexpr std::uint64_t most_nameless_columns = 32;

bool is_image(const NumpyHeader& header) {
  if (header.is_structured || header.is_pickled) return false;
  const std::size_t dimensions = header.shape.size();
  return dimensions == 3 || (dimensions == 2 && header.shape[1] > most_nameless_columns);
}

// Where the values of a column lie in an array.
struct NumpyColumn {
  std::size_t array = 0;
  StoredValues values;             // without its file
  std::optional<double> constant;  // the same for all, instead of values
};

struct NumpyArray {
  std::string name;  // in an archive
  NumpyHeader header;
};

// The values of one member in every record of an array that has `rows` of them.
NumpyColumn member_column(std::size_t array, const NumpyHeader& header, const NumpyMember& member) {
  NumpyColumn column;
  column.array = array;
  column.values.offset = header.data_offset + member.offset;
  column.values.particles = header.rows();
  column.values.values_per_particle = static_cast<int>(member.values);
  column.values.stride = header.record_bytes;
  column.values.kind = member.kind;
  column.values.is_swapped = member.is_swapped;
  return column;
}

// `width` columns of a plain array of two dimensions, from `first` on.
NumpyColumn plain_column(std::size_t array, const NumpyHeader& header, std::uint64_t first,
                         std::uint64_t width) {
  NumpyColumn column = member_column(array, header, header.members.front());
  const std::uint64_t bytes = header.record_bytes;
  const std::uint64_t columns = header.shape.size() > 1 ? header.shape[1] : 1;
  column.values.values_per_particle = static_cast<int>(width);
  column.values.stride = header.is_fortran_order ? bytes : bytes * columns;
  column.values.axis_stride = header.is_fortran_order ? bytes * header.rows() : bytes;
  column.values.offset += first * column.values.axis_stride;
  return column;
}

class NumpyTable : public Table {
 public:
  // `numbers_columns`: those of an array without names are column_1, column_2, ...
  NumpyTable(const fs::path& path, const std::vector<std::string>& names, SnapshotInfo& info,
             bool numbers_columns = false);

  const std::vector<TableColumn>& columns() const override { return columns_; }
  std::uint64_t rows() const override { return rows_; }
  void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const override;
  bool is_single_precision(std::size_t column) const override {
    if (const auto& constant = places_[column].constant)
      return static_cast<double>(static_cast<float>(*constant)) == *constant;
    return holds_single_precision(places_[column].values.kind);
  }
  std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const override;

 private:
  void open_archive(std::vector<std::string>& notes);
  void refuse_objects() const;
  void refuse_other_kinds() const;
  void refuse_image() const;
  std::vector<double> few_numbers(std::size_t array) const;
  void read_numbers(SnapshotInfo& info);
  std::vector<TableColumn> arrays_as_columns() const;
  void name_positions(std::vector<std::string>& notes);
  void choose_rows();
  void add_array(std::size_t array, const std::vector<std::string>& names);
  void add_members(std::size_t array);
  void add_plain(std::size_t array, const std::vector<std::string>& names);
  void add_named(std::size_t array, const std::vector<std::string>& names);
  void add(const std::string& name, NumpyColumn column);
  void add_number_for_all(const std::string& name, double value);
  void refuse_lost_axis() const;
  bool may_be_colors() const;
  std::shared_ptr<const MappedFile> content(std::size_t array) const;

  fs::path path_;
  std::unique_ptr<ZipArchive> archive_;
  std::shared_ptr<const MappedFile> file_;  // of a single array
  bool numbers_columns_ = false;            // those of an array without names, from 1
  std::vector<NumpyArray> arrays_;
  std::vector<std::size_t> of_the_whole_;  // those of time, redshift and box
  std::vector<std::size_t> entries_;       // of the archive, for each array
  std::vector<TableColumn> columns_;
  std::vector<NumpyColumn> places_;
  std::vector<std::string> left_out_;
  std::uint64_t rows_ = 0;
};

NumpyTable::NumpyTable(const fs::path& path, const std::vector<std::string>& names,
                       SnapshotInfo& info, bool numbers_columns)
    : path_(path), file_(MappedFile::open(path)), numbers_columns_(numbers_columns) {
  if (is_numpy_array(file_->data(), file_->size())) {
    info.format = "NumPy array";
    arrays_.push_back(
        {"", read_numpy_header(file_->data(), file_->size(), file_->size(), path.string())});
    refuse_objects();
    refuse_other_kinds();
    if (names.empty() && !numbers_columns) refuse_image();
  } else {
    info.format = "NumPy archive";
    open_archive(info.notes);
    refuse_objects();
    read_numbers(info);
    name_positions(info.notes);
  }
  if (!names.empty() && arrays_.size() > 1) {
    throw DataError(path.string() +
                    ": an archive of several arrays, which have names; leave read.columns out");
  }
  choose_rows();
  for (std::size_t array = 0; array < arrays_.size(); ++array)
    add_array(array, names);
  refuse_lost_axis();
  if (names.empty() && !numbers_columns && may_be_colors()) {
    info.notes.push_back(
        "its rows of few numbers are taken for positions; if they are colors, name the file as a "
        "palette");
  }
  if (!left_out_.empty()) {
    info.notes.push_back(
        fmt::format("left out, as they are not one or three numbers for each of {} particles: {}",
                    rows_, fmt::join(left_out_, ", ")));
  }
  if (rows_ == 0) throw DataError(path.string() + ": the arrays have no rows; expected particles");
}

void NumpyTable::open_archive(std::vector<std::string>& notes) {
  archive_ = std::make_unique<ZipArchive>(path_);
  std::vector<std::string> others;
  for (std::size_t i = 0; i < archive_->entries().size(); ++i) {
    const ZipArchive::Entry& entry = archive_->entries()[i];
    constexpr std::uint64_t longest_header = 1U << 17;
    const std::vector<std::byte> start = archive_->read(entry, longest_header);
    if (!is_numpy_array(start.data(), start.size())) {
      others.push_back(entry.name);
      continue;
    }
    std::string name = entry.name;
    if (name.size() > 4 && name.substr(name.size() - 4) == ".npy") name.resize(name.size() - 4);
    arrays_.push_back({name, read_numpy_header(start.data(), start.size(), entry.bytes,
                                               path_.string() + ": " + entry.name)});
    entries_.push_back(i);
  }
  if (arrays_.empty()) {
    throw DataError(path_.string() +
                    ": a zip archive without NumPy arrays; unpack it, or give an .npz file");
  }
  if (!others.empty()) {
    notes.push_back(fmt::format("left out of the archive, as they are no NumPy arrays: {}",
                                fmt::join(others, ", ")));
  }
}

// Where there is nothing else.
void NumpyTable::refuse_objects() const {
  const bool has_values = std::any_of(arrays_.begin(), arrays_.end(), [](const NumpyArray& array) {
    return !array.header.is_pickled;
  });
  if (has_values) return;
  throw DataError(
      path_.string() +
      ": holds objects of Python (NumPy's type '|O'), which are not read, expected numbers: save "
      "it again as such, with numpy.save(FILE, array.astype(float)) where they are numbers, or as "
      "an array of records or a numpy.savez archive of an array for each field");
}

// Of a single array.
void NumpyTable::refuse_other_kinds() const {
  const NumpyHeader& header = arrays_.front().header;
  if (header.is_structured || header.members.front().is_usable) return;
  throw DataError(path_.string() +
                  ": holds values that are no real numbers, such as complex ones, texts or dates, "
                  "expected whole numbers or floats: save array.real or array.astype(float)");
}

void NumpyTable::refuse_image() const {
  const NumpyHeader& header = arrays_.front().header;
  if (!is_image(header)) return;
  throw DataError(fmt::format(
      "{}: found an array of {} numbers, as images and maps are, expected particles: rows of x, y, "
      "z and at most {} more; save array[:, :3] where these are positions",
      path_.string(), fmt::join(header.shape, " x "), most_nameless_columns - 3));
}

// Of an array of a single number, or of the sides of a box; empty for others.
std::vector<double> NumpyTable::few_numbers(std::size_t array) const {
  constexpr std::uint64_t most = 3;
  const NumpyHeader& header = arrays_[array].header;
  const bool are_numbers = !header.is_structured && header.members.front().is_usable;
  const std::uint64_t count = header.shape.empty() ? 1 : header.rows();
  if (!are_numbers || header.shape.size() > 1 || count > most) return {};
  StoredValues stored = plain_column(array, header, 0, 1).values;
  stored.file = content(array);
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < count; ++i)
    numbers.push_back(value_at(stored, i, 0));
  return numbers;
}

// Numbers that say something about the whole.
void NumpyTable::read_numbers(SnapshotInfo& info) {
  for (std::size_t array = 0; array < arrays_.size(); ++array) {
    const std::vector<double> numbers = few_numbers(array);
    if (numbers.empty()) continue;
    const std::string& name = arrays_[array].name;
    const auto is_called = [&name](const char* wanted) {
      return equal_ignoring_case(name, wanted);
    };
    const bool is_one = numbers.size() == 1;
    const bool is_box = is_called("box_size") || is_called("BoxSize");
    if (is_one && is_called("time")) info.time = numbers.front();
    if (is_one && is_called("redshift")) info.redshift = numbers.front();
    if (is_box) info.box_size = box_stated(numbers, info.notes);
    if (is_box || (is_one && (is_called("time") || is_called("redshift"))))
      of_the_whole_.push_back(array);
    if (arrays_[array].header.shape.empty()) add_number_for_all(name, numbers.front());
  }
}

// A single mass or smoothing length is that of every particle.
void NumpyTable::add_number_for_all(const std::string& name, double value) {
  const std::string field = canonical_field_name(name);
  if (field != "mass" && field != "smoothing_length" && field != "density") return;
  NumpyColumn column;
  column.values.values_per_particle = 1;
  column.constant = value;
  add(name, std::move(column));
}

// As many rows as palettes tend to have, of red, green and blue.
bool NumpyTable::may_be_colors() const {
  constexpr std::array<std::uint64_t, 7> usual = {16, 32, 64, 128, 256, 512, 1024};
  const NumpyHeader& header = arrays_.front().header;
  const bool is_nameless = arrays_.size() == 1 && arrays_.front().name.empty();
  const bool has_rows = std::find(usual.begin(), usual.end(), rows_) != usual.end();
  if (!is_nameless || header.is_structured || !has_rows || header.shape.size() != 2) return false;
  if (header.shape[1] > 4) return false;
  if (header.members.front().kind == ValueKind::uint8) return true;
  bool are_parts = true;
  for_rows({{0, 0}, {0, 1}, {0, 2}}, [&are_parts](const double* row) {
    are_parts = are_parts && std::all_of(row, row + 3, [](double c) { return c >= 0 && c <= 1; });
  });
  return are_parts;
}

void NumpyTable::refuse_lost_axis() const {
  const std::string axis = lost_axis(columns_, left_out_);
  if (axis.empty()) return;
  throw DataError(fmt::format(
      "{}: {} is not one number for each of {} particles, as the other axes of the positions are; "
      "save arrays of one length",
      path_.string(), axis, rows_));
}

// The plain arrays of an archive as columns, in their order; others have no name.
std::vector<TableColumn> NumpyTable::arrays_as_columns() const {
  std::vector<TableColumn> columns;
  for (const NumpyArray& array : arrays_) {
    const NumpyHeader& header = array.header;
    const bool is_column = !header.is_structured && header.members.front().is_usable &&
                           (header.shape.size() == 1 || header.shape.size() == 2);
    const std::uint64_t width = header.shape.size() == 2 ? header.shape[1] : 1;
    const bool has_few = width == 1 || width == 3;
    columns.push_back(is_column && has_few ? TableColumn{array.name, static_cast<int>(width)}
                                           : TableColumn{"", 1});
  }
  return columns;
}

// Where no array has the name of positions, the only one that can be them is taken.
void NumpyTable::name_positions(std::vector<std::string>& notes) {
  const bool has_records = std::any_of(arrays_.begin(), arrays_.end(), [](const NumpyArray& array) {
    return array.header.is_structured && !array.header.is_pickled;
  });
  const auto guessed = has_records ? std::nullopt : guess_positions(arrays_as_columns());
  if (!guessed) return;
  notes.push_back(fmt::format("the array {} is taken for the positions", arrays_[*guessed].name));
  arrays_[*guessed].name = "position";
}

// As many as the positions have, or the first array.
void NumpyTable::choose_rows() {
  if (const auto positions = find_positions(arrays_as_columns())) {
    rows_ = arrays_[*positions].header.rows();
    return;
  }
  const auto first = std::find_if(arrays_.begin(), arrays_.end(), [](const NumpyArray& array) {
    return !array.header.shape.empty() && !array.header.is_pickled;
  });
  if (first != arrays_.end()) rows_ = first->header.rows();
}

void NumpyTable::add(const std::string& name, NumpyColumn column) {
  const int width = column.values.values_per_particle;
  if ((width != 1 && width != 3) || columns_.size() >= most_columns) {
    left_out_.push_back(name);
    return;
  }
  columns_.push_back({name, width});
  places_.push_back(std::move(column));
}

void NumpyTable::add_array(std::size_t array, const std::vector<std::string>& names) {
  const NumpyHeader& header = arrays_[array].header;
  if (header.is_pickled) {
    left_out_.push_back(arrays_[array].name);
    return;
  }
  if (header.shape.empty()) return;  // a single number
  const bool fits = header.rows() == rows_ && header.shape.size() <= (header.is_structured ? 1 : 2);
  if (!fits) {
    const bool is_read =
        std::find(of_the_whole_.begin(), of_the_whole_.end(), array) != of_the_whole_.end();
    if (!is_read) left_out_.push_back(arrays_[array].name);
  } else if (header.is_structured) {
    if (!names.empty()) {
      throw UsageError(path_.string() + ": its columns have names; leave read.columns out");
    }
    add_members(array);
  } else if (!header.members.front().is_usable) {
    left_out_.push_back(arrays_[array].name);
  } else {
    add_plain(array, names);
  }
}

void NumpyTable::add_members(std::size_t array) {
  const NumpyHeader& header = arrays_[array].header;
  for (const NumpyMember& member : header.members) {
    const bool is_usable = member.is_usable && (member.values == 1 || member.values == 3);
    if (is_usable) {
      add(member.name, member_column(array, header, member));
    } else if (!member.name.empty()) {
      left_out_.push_back(member.name);
    }
  }
}

void NumpyTable::add_plain(std::size_t array, const std::vector<std::string>& names) {
  const NumpyHeader& header = arrays_[array].header;
  const std::uint64_t width = header.shape.size() > 1 ? header.shape[1] : 1;
  if (!names.empty()) {
    add_named(array, names);
  } else if (!arrays_[array].name.empty()) {
    if (width == 1 || width == 3) {
      add(arrays_[array].name, plain_column(array, header, 0, width));
    } else {
      left_out_.push_back(arrays_[array].name);
    }
  } else if (numbers_columns_) {
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(width, most_columns); ++i)
      add(fmt::format("column_{}", i + 1), plain_column(array, header, i, 1));
  } else if (width >= 3) {
    add("position", plain_column(array, header, 0, 3));
    for (std::uint64_t i = 3; i < std::min<std::uint64_t>(width, most_columns); ++i) {
      add(fmt::format("column_{}", i + 1), plain_column(array, header, i, 1));
    }
  } else {
    throw DataError(fmt::format(
        "{}: an array of {} columns, expected at least three, x, y and z{}", path_.string(), width,
        header.rows() == 3 ? ": save its transpose" : " or an array of records with names"));
  }
}

void NumpyTable::add_named(std::size_t array, const std::vector<std::string>& names) {
  const NumpyHeader& header = arrays_[array].header;
  const std::uint64_t width = header.shape.size() > 1 ? header.shape[1] : 1;
  if (names.size() != width) {
    throw UsageError(
        fmt::format("{}: an array of {} columns, but read.columns names {}; name each of "
                    "them (\"-\" for those that are not needed)",
                    path_.string(), width, names.size()));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != "-") add(names[i], plain_column(array, header, i, 1));
  }
}

std::shared_ptr<const MappedFile> NumpyTable::content(std::size_t array) const {
  if (!archive_) {
    file_->check_size();
    return file_;
  }
  const ZipArchive::Entry& entry = archive_->entries()[entries_[array]];
  auto bytes = archive_->read(entry, entry.bytes);
  return MappedFile::of_bytes(path_, std::move(bytes));
}

void NumpyTable::for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const {
  std::map<std::size_t, std::shared_ptr<const MappedFile>> contents;
  std::vector<StoredValues> stored;
  std::vector<std::size_t> in_files;  // of the wanted
  for (const TableValue& value : wanted) {
    const NumpyColumn& column = places_[value.column];
    stored.push_back(column.values);
    if (column.constant) continue;
    in_files.push_back(stored.size() - 1);
    auto& file = contents[column.array];
    if (!file) file = content(column.array);
    stored.back().file = file;
  }
  std::vector<double> values(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    values[i] = places_[wanted[i].column].constant.value_or(0);
  for (std::uint64_t row = 0; row < rows_; ++row) {
    for (const std::size_t i : in_files)
      values[i] = value_at(stored[i], row, wanted[i].axis);
    use(values.data());
  }
}

std::optional<std::vector<std::uint64_t>> NumpyTable::integers(std::size_t column) const {
  if (places_[column].constant) return std::nullopt;
  StoredValues stored = places_[column].values;
  stored.file = content(places_[column].array);
  return make_integers({stored});
}

bool is_zip(const MappedFile& file) {
  constexpr std::array<char, 4> magic = {'P', 'K', 3, 4};
  return file.size() >= magic.size() && std::memcmp(file.data(), magic.data(), magic.size()) == 0;
}

class NumpyFormat : public SnapshotFormat {
 public:
  bool recognizes(const std::shared_ptr<const MappedFile>& file) const override {
    return is_numpy_array(file->data(), file->size()) || is_zip(*file);
  }
  std::unique_ptr<Snapshot> open(const fs::path& path,
                                 const SnapshotOptions& options) const override {
    const PathInFile place = path_in_file(path).value_or(PathInFile{path, ""});
    SnapshotInfo info;
    info.files = {place.file};
    const bool has_new_names = names_columns_anew(options.columns);
    std::unique_ptr<const Table> table = std::make_unique<NumpyTable>(
        place.file, has_new_names ? std::vector<std::string>() : options.columns, info,
        has_new_names);
    table = with_new_names(std::move(table), options.columns, place.file);
    table = with_one_step(std::move(table), place.group, info);
    table = with_flat_positions(std::move(table), info.notes);
    return make_table_snapshot(std::move(table), std::move(info));
  }
  bool is_map(const fs::path& path) const override {
    const auto file = MappedFile::open(path);
    if (!is_numpy_array(file->data(), file->size())) return false;
    try {
      return is_image(read_numpy_header(file->data(), file->size(), file->size(), path.string()));
    } catch (const DataError&) {
      return false;
    }
  }
  bool has_groups() const override { return true; }
  std::vector<std::string> groups_in(const fs::path& path,
                                     const std::string& group) const override {
    SnapshotInfo info;
    return group.empty() ? steps_in(NumpyTable(path, {}, info, false)) : std::vector<std::string>();
  }
  bool has_columns(const std::vector<std::string>&) const override { return true; }
};

}  // namespace

const SnapshotFormat& numpy_format() {
  static const NumpyFormat format;
  return format;
}

}  // namespace splotchcl
