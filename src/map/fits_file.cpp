#include <fitsio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "map/map_files.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// A column of a table: one number a row.
struct FitsColumn {
  std::string name, unit;
  std::vector<float> values;
  int in_a_row = 1;  // several in one row, where that divides them
};

// A file in memory, so that what is written to the disk is ours to check.
class FitsWriter {
 public:
  // `path` is for messages.
  explicit FitsWriter(const std::filesystem::path& path);

  // The first axis changes fastest.
  void add_image(const std::vector<long>& sides, std::vector<float> values);
  void add_table(const std::vector<FitsColumn>& columns);
  void add_text(const char* key, const std::string& text, const char* comment);
  void add_number(const char* key, double value, const char* comment);
  void add_count(const char* key, long value, const char* comment);
  // Lines of a header hold printable ASCII only.
  void add_history(std::string text);
  void announce_long_texts();
  std::vector<unsigned char> bytes();

 private:
  // What a file in memory lies in, whose library makes it longer.
  struct FileMemory {
    static constexpr std::size_t block = 2880;

    FileMemory() = default;
    ~FileMemory() { std::free(data); }
    FileMemory(const FileMemory&) = delete;
    FileMemory& operator=(const FileMemory&) = delete;

    std::size_t size = block;
    void* data = std::malloc(block);
  };
  struct CloseFits {
    void operator()(fitsfile* file) const;
  };
  void check() const;

  std::filesystem::path path_;
  FileMemory memory_;  // outlives the file
  std::unique_ptr<fitsfile, CloseFits> file_;
  int status_ = 0;
};

void FitsWriter::CloseFits::operator()(fitsfile* file) const {
  int ignored = 0;
  fits_close_file(file, &ignored);
}

FitsWriter::FitsWriter(const std::filesystem::path& path) : path_(path) {
  fitsfile* file = nullptr;
  fits_create_memfile(&file, &memory_.data, &memory_.size, FileMemory::block, std::realloc,
                      &status_);
  file_.reset(file);
  check();
}

void FitsWriter::add_image(const std::vector<long>& sides, std::vector<float> values) {
  std::vector<long> axes = sides;
  fits_create_img(file_.get(), FLOAT_IMG, static_cast<int>(axes.size()), axes.data(), &status_);
  fits_write_img(file_.get(), TFLOAT, 1, static_cast<LONGLONG>(values.size()), values.data(),
                 &status_);
  check();
}

void FitsWriter::add_table(const std::vector<FitsColumn>& columns) {
  std::vector<std::string> texts;  // names, formats and units, which the library takes as char*
  for (const FitsColumn& column : columns) {
    texts.push_back(column.name);
    texts.push_back(std::to_string(column.in_a_row) + "E");
    texts.push_back(column.unit);
  }
  std::vector<char*> names, formats, units;
  for (std::size_t i = 0; i < texts.size(); i += 3) {
    names.push_back(texts[i].data());
    formats.push_back(texts[i + 1].data());
    units.push_back(texts[i + 2].data());
  }
  const auto rows = static_cast<LONGLONG>(columns.front().values.size()) / columns.front().in_a_row;
  fits_create_tbl(file_.get(), BINARY_TBL, rows, static_cast<int>(columns.size()), names.data(),
                  formats.data(), units.data(), nullptr, &status_);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::vector<float> values = columns[i].values;
    fits_write_col(file_.get(), TFLOAT, static_cast<int>(i) + 1, 1, 1,
                   static_cast<LONGLONG>(values.size()), values.data(), &status_);
  }
  check();
}

void FitsWriter::add_text(const char* key, const std::string& text, const char* comment) {
  fits_update_key_longstr(file_.get(), key, text.c_str(), comment, &status_);
  check();
}

void FitsWriter::add_number(const char* key, double value, const char* comment) {
  fits_update_key(file_.get(), TDOUBLE, key, &value, comment, &status_);
  check();
}

void FitsWriter::add_count(const char* key, long value, const char* comment) {
  fits_update_key(file_.get(), TLONG, key, &value, comment, &status_);
  check();
}

void FitsWriter::add_history(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = ' ';
  }
  fits_write_history(file_.get(), text.c_str(), &status_);
  check();
}

void FitsWriter::announce_long_texts() {
  fits_write_key_longwarn(file_.get(), &status_);
  check();
}

std::vector<unsigned char> FitsWriter::bytes() {
  LONGLONG header = 0, data = 0, end = 0;
  fits_get_hduaddrll(file_.get(), &header, &data, &end, &status_);
  fits_close_file(file_.release(), &status_);
  check();
  const auto* const first = static_cast<const unsigned char*>(memory_.data);
  return {first, first + end};
}

void FitsWriter::check() const {
  if (status_ == 0) return;
  char reason[FLEN_STATUS];
  fits_get_errstatus(status_, reason);
  throw DataError(path_.string() + ": could not be made: " + reason);
}

bool begins_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool belongs_to_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string name_in_fits(const std::string& name) {
  static const std::map<std::string, std::string> names = {
      {"Msun", "solMass"},    {"M_sun", "solMass"},  {"Rsun", "solRad"}, {"R_sun", "solRad"},
      {"Lsun", "solLum"},     {"L_sun", "solLum"},   {"ly", "lyr"},      {"au", "AU"},
      {"particles", "count"}, {"a", "scale_factor"}, {"h", "little_h"},
  };
  const auto found = names.find(name);
  return found == names.end() ? name : found->second;
}

// 1e10, the only numbers that the standard has.
std::string power_of_ten(const std::string& number) {
  return number.rfind("1e", 0) == 0 ? "10**" + number.substr(2) : number;
}

bool is_whole(const std::string& number) {
  const std::size_t first = number.rfind('-', 0) == 0 ? 1 : 0;
  return number.size() > first &&
         std::all_of(number.begin() + static_cast<std::ptrdiff_t>(first), number.end(),
                     [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

// Whether the standard has this factor of a unit: a name to a whole power, or, as the first one, a
// power of ten.
bool is_factor_of_fits(const std::string& factor, bool is_first) {
  const std::size_t mark = std::min(factor.find("**"), factor.size());
  const std::string base = factor.substr(0, mark);
  const bool is_to_whole = mark == factor.size() || is_whole(factor.substr(mark + 2));
  if (base == "10") return is_first && mark != factor.size();
  return is_to_whole && base != "m_p" && !base.empty() &&
         std::all_of(base.begin(), base.end(), [](char c) { return begins_name(c) || c == '_'; });
}

bool is_of_fits(const std::string& text) {
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" /", first), text.size());
    if (end > first && !is_factor_of_fits(text.substr(first, end - first), first == 0))
      return false;
    first = end + 1;
  }
  return true;
}

// "cm**-2", "g**(0.5)": powers that are not whole are in parentheses.
void append_power(std::string& text, const char* base, double power) {
  constexpr double rounding = 1e-6;
  if (std::abs(power) < rounding) return;
  const double whole = std::round(power);
  const bool is_near_whole = std::abs(power - whole) < rounding;
  text += (text.empty() ? "" : " ") + std::string(base);
  if (is_near_whole && whole != 1) text += fmt::format("**{:.0f}", whole);
  if (!is_near_whole) text += fmt::format("**({:.6g})", power);
}

FitsUnit in_cgs(const Unit& unit) {
  // A factor of ten by itself is no number of the standard's.
  double exponent = std::floor(std::log10(unit.in_cgs));
  if (exponent == 1) exponent = 0;
  FitsUnit result;
  result.factor = unit.in_cgs / std::pow(10, exponent);
  append_power(result.text, "10", exponent);
  constexpr const char* names[] = {"cm", "g", "s", "K"};
  for (const std::size_t i : {1U, 0U, 2U, 3U})
    append_power(result.text, names[i], unit.powers[i]);
  return result;
}

}  // namespace

std::string fits_unit(const std::string& unit) {
  std::string result;
  for (std::size_t i = 0; i < unit.size();) {
    const bool is_name = begins_name(unit[i]);
    const bool is_number = !is_name && std::isdigit(static_cast<unsigned char>(unit[i])) != 0;
    if (!is_name && !is_number) {
      result += unit[i] == '^' ? "**" : std::string(1, unit[i]);
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < unit.size() && (belongs_to_name(unit[end]) || (is_number && unit[end] == '.')))
      ++end;
    const std::string word = unit.substr(i, end - i);
    result += is_name ? name_in_fits(word) : power_of_ten(word);
    i = end;
  }
  return result;
}

FitsUnit readable_fits_unit(const std::string& unit) {
  const std::string text = fits_unit(unit);
  if (is_of_fits(text)) return {text};
  try {
    const Unit known = parse_unit(unit, {}, "unit");
    if (known.in_cgs > 0 && std::isfinite(known.in_cgs)) return in_cgs(known);
  } catch (const UsageError&) {
    // With a and h, or names that nobody else knows.
  }
  return {text};
}

namespace {

std::vector<float> times(std::vector<float> values, double factor) {
  if (factor == 1) return values;
  for (float& value : values)
    value = static_cast<float>(factor * static_cast<double>(value));
  return values;
}

// A map's rows from the lowest on, plane by plane.
void add_image(FitsWriter& file, const Map& map, const std::vector<float>& values) {
  std::vector<long> sides = {map.width, map.height};
  if (map.velocity || map.shape == MapShape::voxels) sides.push_back(map.planes());
  file.add_image(sides, upside_down(values, map.width, map.height));
}

struct FitsAxis {
  std::string name, unit;
  double center, step;
  int pixels;
  const char* of_middle = "the middle of the map";
  double middle = 0.5 * pixels + 0.5;  // the pixel that the center is told of
};

// `number` is that of the axis, with the letter of the system of coordinates.
void add_axis(FitsWriter& file, const std::string& number, const FitsAxis& axis) {
  file.add_text(("CTYPE" + number).c_str(), axis.name, "");
  file.add_text(("CUNIT" + number).c_str(), axis.unit, "");
  file.add_number(("CRPIX" + number).c_str(), axis.middle, axis.of_middle);
  file.add_number(("CRVAL" + number).c_str(), axis.center, "");
  file.add_number(("CDELT" + number).c_str(), axis.step, "");
}

// With CAR the place that is told of has to lie on the equator.
void add_sky(FitsWriter& file, const Map& map) {
  const SkyPlace& sky = *map.sky;
  const bool is_plane = sky.projection == "TAN";
  const std::string right = "RA---" + sky.projection, up = "DEC--" + sky.projection;
  const double beyond = is_plane ? 0 : sky.declination / sky.pixel;
  const char* const of_equator = "the equator below the middle of the map";
  add_axis(file, "1", {right, "deg", sky.right_ascension, -sky.pixel, map.width});
  add_axis(file, "2",
           {up, "deg", is_plane ? sky.declination : 0, sky.pixel, map.height,
            is_plane ? "the middle of the map" : of_equator, 0.5 * map.height + 0.5 - beyond});
  file.add_text("RADESYS", "ICRS", "");
}

// Lengths, or logarithms where the axis is logarithmic.
void add_map_axis(FitsWriter& file, const std::string& number, const MapAxis& axis) {
  const std::string unit = fits_unit(axis.unit);
  if (!axis.is_logarithmic) {
    add_axis(file, number,
             {axis.name, unit, 0.5 * (axis.first + axis.last),
              (axis.last - axis.first) / axis.cells, axis.cells});
    return;
  }
  const double low = std::log10(axis.first), high = std::log10(axis.last);
  add_axis(file, number,
           {"log10(" + axis.name + ")", "log(" + unit + ")", 0.5 * (low + high),
            (high - low) / axis.cells, axis.cells});
}

// Lengths alone, or coordinates on the sky, with lengths as another system, "P". Names of axes that
// the standard does not have are linear.
void add_place(FitsWriter& file, const Map& map) {
  if (!map.axes.empty()) {
    for (std::size_t i = 0; i < map.axes.size(); ++i)
      add_map_axis(file, std::to_string(i + 1), map.axes[i]);
    return;
  }
  if (map.sky) add_sky(file, map);
  if (map.shape == MapShape::sky) return;
  const std::string unit = fits_unit(map.length_unit), letter = map.sky ? "P" : "";
  if (map.sky) file.add_text("WCSNAMEP", "lengths", "");
  add_axis(file, "1" + letter, {map.right_name, unit, map.center_right, map.pixel, map.width});
  add_axis(file, "2" + letter, {map.up_name, unit, map.center_up, map.pixel, map.height});
}

// Spectral where it is known to be a velocity: positive away from who looks.
void add_velocities(FitsWriter& file, const Map& map) {
  if (!map.velocity) return;
  const VelocityAxis& axis = *map.velocity;
  const bool is_known = axis.unit == "km/s";
  const double middle = axis.first + 0.5 * (axis.channels - 1) * axis.step;
  const FitsAxis of_fits = {
      is_known ? "VELO" : "velocity", fits_unit(axis.unit), middle, axis.step, axis.channels,
      "the middle of the channels"};
  add_axis(file, "3", of_fits);
  if (map.sky) add_axis(file, "3P", of_fits);
}

// As readers of Healpix maps have it: values that are not there by a number of its own, and rows of
// 1024 pixels where there are as many.
void add_sphere(FitsWriter& file, const Map& map, std::vector<float> values,
                const std::string& unit) {
  constexpr float not_there = -1.6375e30F;
  constexpr int row = 1024;
  std::replace_if(
      values.begin(), values.end(), [](float value) { return std::isnan(value); }, not_there);
  const int in_a_row = values.size() % row == 0 ? row : 1;
  file.add_table({{"VALUE", unit, std::move(values), in_a_row}});
  file.add_text("PIXTYPE", "HEALPIX", "pixels of equal area");
  file.add_text("ORDERING", map.healpix->order == HealpixOrder::ring ? "RING" : "NESTED", "");
  file.add_count("NSIDE", map.healpix->nside, "");
  file.add_count("FIRSTPIX", 0, "");
  file.add_count("LASTPIX", map.width - 1, "");
  file.add_text("INDXSCHM", "IMPLICIT", "");
  file.add_text("OBJECT", "FULLSKY", "");
  file.add_number("BAD_DATA", static_cast<double>(not_there), "no value");
}

void add_profile(FitsWriter& file, const Map& map, const std::vector<float>& values,
                 const std::string& unit) {
  FitsColumn inner = {"INNER", fits_unit(map.axes[0].unit), {}, 1}, outer = inner;
  outer.name = "OUTER";
  for (int i = 0; i < map.width; ++i) {
    inner.values.push_back(static_cast<float>(map.axes[0].edge(i)));
    outer.values.push_back(static_cast<float>(map.axes[0].edge(i + 1)));
  }
  file.add_table({inner, outer, {"VALUE", unit, values, 1}});
}

void add_values(FitsWriter& file, const Map& map) {
  const FitsUnit unit = readable_fits_unit(map.unit);
  const std::vector<float> values = times(map.values, unit.factor);
  if (map.shape == MapShape::healpix) {
    add_sphere(file, map, values, unit.text);
    file.announce_long_texts();
    return;
  }
  if (map.shape == MapShape::profile) {
    add_profile(file, map, values, unit.text);
    file.announce_long_texts();
    return;
  }
  add_image(file, map, values);
  file.announce_long_texts();
  file.add_text("BUNIT", unit.text, "");
  add_place(file, map);
  add_velocities(file, map);
}

void add_shell(FitsWriter& file, const Map& map) {
  if (!map.shell || map.shape == MapShape::profile) return;
  const std::string unit = "in " + fits_unit(map.length_unit);
  file.add_number("RMIN", (*map.shell)[0], unit.c_str());
  file.add_number("RMAX", (*map.shell)[1], unit.c_str());
}

}  // namespace

std::vector<unsigned char> encode_fits(const std::filesystem::path& path, const Map& map,
                                       const SnapshotInfo& snapshot, const MapMetadata& metadata) {
  FitsWriter file(path);
  add_values(file, map);
  add_shell(file, map);
  file.add_text("QUANTITY", map.quantity, "");
  if (map.axes.empty() && map.shape != MapShape::healpix)
    file.add_text("VIEW", map.view, "axes to the right and upwards");
  file.add_number("TOLERANC", map.tolerance, "of each sum, relative to max(sum, FLOOR)");
  file.add_number("FLOOR", map.floor, "of the column of weights, in the data's units");
  if (snapshot.redshift) file.add_number("REDSHIFT", *snapshot.redshift, "");
  file.add_number("TIME", snapshot.time, "as the snapshot has it");
  for (const auto& [key, text] : metadata)
    file.add_history(key + ": " + text);
  if (!map.effective_particles.empty()) {
    add_image(file, map, map.effective_particles);
    file.add_text("EXTNAME", "EFFECTIVE_PARTICLES", "");
    add_place(file, map);
  }
  return file.bytes();
}

}  // namespace splotchcl
