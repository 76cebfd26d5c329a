#include "formats/hdf5/gadget_hdf5_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "formats/hdf5/hdf5_table.h"
#include "formats/hdf5/hdf5_units.h"
#include "scene/constants.h"
#include "snapshot/field_names.h"
#include "snapshot/stated_numbers.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct AttributeLocation {
  const char* object;
  const char* attribute;
};

// The first of the locations that has a number.
double find_number(const Hdf5File& file, const std::vector<AttributeLocation>& locations,
                   double otherwise) {
  for (const AttributeLocation& location : locations) {
    if (const auto number = file.number(location.object, location.attribute)) return *number;
  }
  return otherwise;
}

// Of a dataset of the first type that states it; 0: none does.
double size_of_unit(const Hdf5File& file, const std::string& label, const char* attribute) {
  constexpr int most_types = 8;
  for (int type = 0; type < most_types; ++type) {
    const auto size = file.number(fmt::format("PartType{}/{}", type, label), attribute);
    if (size && *size > 0) return *size;
  }
  return 0;
}

double size_of_swift_unit(const Hdf5File& file, const std::string& label) {
  return size_of_unit(file, label, size_in_swift);
}

// Without the units of the whole file those of its datasets tell.
BaseUnits read_units_of_datasets(const Hdf5File& file) {
  BaseUnits units;
  for (const char* const attribute : {size_in_swift, size_in_eagle, size_in_gadget}) {
    units.length_in_cm = size_of_unit(file, "Coordinates", attribute);
    units.mass_in_g = size_of_unit(file, "Masses", attribute);
    if (units.mass_in_g == 0) units.mass_in_g = size_of_unit(file, "Mass", attribute);
    units.velocity_in_cm_per_s = size_of_unit(file, "Velocities", attribute);
    if (units.velocity_in_cm_per_s == 0)
      units.velocity_in_cm_per_s = size_of_unit(file, "Velocity", attribute);
    if (units.length_in_cm > 0) break;
  }
  return units;
}

// Whole numbers of at least 0; none, and a note, where one is something else. The datasets
// themselves tell how many particles there are.
std::vector<std::uint64_t> read_counts(const Hdf5File& file, const char* attribute,
                                       std::vector<std::string>& notes) {
  constexpr double largest = 9007199254740992.0;  // beyond 2^53 a double is not exact
  std::vector<std::uint64_t> counts;
  for (const double number : file.numbers("Header", attribute).value_or(std::vector<double>())) {
    if (!(number >= 0 && number <= largest) || number != std::floor(number)) {
      notes.push_back(
          fmt::format("Header/{} holds {} as a number of particles; ignored", attribute, number));
      return {};
    }
    counts.push_back(static_cast<std::uint64_t>(number));
  }
  return counts;
}

// One length for all axes, or one for each.
std::optional<BoxSides> read_box_size(const Hdf5File& file, std::vector<std::string>& notes) {
  auto sides = file.numbers("Header", "BoxSize");
  if (!sides) sides = file.numbers("Parameters", "BoxSize");
  return sides ? box_stated(*sides, notes) : std::nullopt;
}

// What is a text that is no number says nothing to us.
void note_texts(const Hdf5File& file, std::vector<std::string>& notes) {
  for (const char* const name : {"BoxSize", "Time", "Redshift", "HubbleParam", "MassTable",
                                 "Omega0", "OmegaLambda", "NumFilesPerSnapshot"}) {
    const auto text = file.text("Header", name);
    if (!text || file.numbers("Header", name)) continue;
    notes.push_back(fmt::format("Header/{} is the text \"{}\", not a number: ignored", name,
                                text->substr(0, 40)));
  }
}

// Where the header does not state it, that of the scale factor.
double read_redshift(const Hdf5File& file, const GadgetHeader& header,
                     std::vector<std::string>& notes) {
  if (const auto redshift = file.number("Header", "Redshift")) return *redshift;
  const bool may_be_time = header.omega_matter > 0 && !is_swift_file(file);
  const double scale_factor =
      find_number(file, {{"Header", "Scale-factor"}, {"Header", "ExpansionFactor"}},
                  may_be_time ? header.time : 0);
  if (!(scale_factor > 0 && scale_factor <= 1)) return 0;
  const double redshift = 1 / scale_factor - 1;
  if (redshift > 0) {
    notes.push_back(
        fmt::format("the header states no redshift: {:.6g} follows from the scale factor, {}",
                    redshift, scale_factor));
  }
  return redshift;
}

}  // namespace

bool is_without_cosmology(const Hdf5File& file) {
  return find_number(file,
                     {{"Parameters", "ComovingIntegrationOn"},
                      {"Header", "ComovingIntegrationOn"},
                      {"Cosmology", "Cosmological run"}},
                     1) == 0;
}

GadgetHeader read_hdf5_header(const Hdf5File& file, std::vector<std::string>& notes) {
  constexpr std::size_t most_types = 32;  // more than any code has
  const auto counts = read_counts(file, "NumPart_ThisFile", notes);
  const bool has_header = file.numbers("Header", "NumPart_ThisFile").has_value();
  if (!has_header || counts.size() > most_types) {
    constexpr std::size_t most_listed = 20;
    const std::vector<std::string> contents = list_contents(file, most_listed);
    throw DataError(fmt::format(
        "{}: the HDF5 file has no attribute NumPart_ThisFile in a group Header, and no positions "
        "whose names tell what they are (it holds: {}{}); say which they are, as in read.columns = "
        "{{x = \"group/x\", y = \"group/y\", z = \"group/z\"}}",
        file.path().string(), fmt::join(contents, ", "),
        contents.size() == most_listed ? ", ..." : ""));
  }
  note_texts(file, notes);
  GadgetHeader header;
  header.counts = counts;
  constexpr std::size_t usual_types = 6;
  if (header.counts.empty()) header.counts.resize(usual_types, 0);
  const std::size_t types = header.counts.size();
  header.total_counts = read_counts(file, "NumPart_Total", notes);
  header.total_counts.resize(types, 0);
  header.total_counts_high = read_counts(file, "NumPart_Total_HighWord", notes);
  header.total_counts_high.resize(types, 0);
  header.table_masses = file.numbers("Header", "MassTable").value_or(std::vector<double>());
  header.table_masses.resize(types, 0);
  header.time = file.number("Header", "Time").value_or(0);
  // Gadget 4's light cones have the shorter name.
  const double files =
      find_number(file, {{"Header", "NumFilesPerSnapshot"}, {"Header", "NumFiles"}}, 1);
  header.files = files >= 1 && files <= 1e9 ? static_cast<int>(files) : 1;
  header.box_size = read_box_size(file, notes);
  header.hubble_parameter = hubble_parameter_of(
      find_number(
          file, {{"Header", "HubbleParam"}, {"Parameters", "HubbleParam"}, {"Cosmology", "h"}}, 0),
      notes);
  if (is_without_cosmology(file)) return header;
  header.omega_matter = find_number(file,
                                    {{"Header", "Omega0"},
                                     {"Header", "Omega_Matter"},
                                     {"Parameters", "Omega0"},
                                     {"Cosmology", "Omega_m"}},
                                    0);
  header.omega_lambda = find_number(file,
                                    {{"Header", "OmegaLambda"},
                                     {"Header", "Omega_Lambda"},
                                     {"Parameters", "OmegaLambda"},
                                     {"Cosmology", "Omega_lambda"}},
                                    0);
  header.redshift = read_redshift(file, header, notes);
  return header;
}

std::string hdf5_dialect(const Hdf5File& file) {
  if (is_swift_file(file)) return "SWIFT HDF5";
  if (is_swift_start_file(file)) return "SWIFT initial conditions, HDF5";
  if (file.number("Header", "GIZMO_version")) return "GIZMO HDF5";
  // A moving mesh has cells with centres and volumes, and no kernel.
  const bool is_mesh = (file.has("/PartType0/CenterOfMass") || file.has("/PartType0/Volume")) &&
                       !file.has("/PartType0/SmoothingLength") &&
                       !file.has("/PartType0/KernelMaxRadius");
  return is_mesh ? "AREPO HDF5" : "Gadget HDF5";
}

bool is_swift_file(const Hdf5File& file) {
  if (file.text("Header", "Code") == "SWIFT" || file.text("Code", "Code") == "SWIFT") return true;
  const bool names_code = file.text("Header", "Code") || file.text("Code", "Code");
  return !names_code && !file.has("Units") && size_of_swift_unit(file, "Coordinates") > 0;
}

bool is_swift_start_file(const Hdf5File& file) {
  const bool has_units = file.number("Units", "Unit length in cgs (U_L)").has_value();
  return has_units && !is_swift_file(file) && !file.has("HydroScheme");
}

std::optional<Cosmology> read_cosmology(const Hdf5File& file, const GadgetHeader& header,
                                        const std::string& positions,
                                        const std::string& velocities) {
  const bool is_swift = is_swift_file(file);
  Cosmology cosmology;
  // SWIFT's time is a time; all others of this family keep the scale factor there.
  const auto scale_factor = file.number("Header", "Scale-factor");
  cosmology.scale_factor =
      scale_factor.value_or(is_swift ? 1 / (1 + header.redshift) : header.time);
  cosmology.omega_matter = header.omega_matter;
  cosmology.omega_lambda = header.omega_lambda;
  constexpr double rounding = 1e-4;
  const bool is_cosmological =
      header.omega_matter > 0 && cosmology.scale_factor > 0 &&
      std::abs(cosmology.scale_factor * (1 + header.redshift) - 1) < rounding;
  if (!is_cosmological) return std::nullopt;

  cosmology.velocity_power = read_scale_factor_power(file, velocities).value_or(is_swift ? 0 : 0.5);
  const double hubble_power =
      find_number(file, {{positions.c_str(), "h_scaling"}, {positions.c_str(), "h-scale exponent"}},
                  is_swift ? 0 : -1);
  const BaseUnits units = read_base_units(file);
  const double length = units.length_in_cm > 0 ? units.length_in_cm : kpc_in_cm;
  const double velocity = units.velocity_in_cm_per_s > 0 ? units.velocity_in_cm_per_s : 1e5;
  // 100 h km/s/Mpc, with the powers of h that the units themselves contain.
  const double h = header.hubble_parameter > 0 ? header.hubble_parameter : 1;
  cosmology.hubble_rate =
      1e7 / (1e3 * kpc_in_cm) * std::pow(h, 1 + hubble_power) * length / velocity;
  return cosmology;
}

BaseUnits read_base_units(const Hdf5File& file) {
  if (has_gizmo_units(file)) return read_gizmo_units(file);
  BaseUnits units;
  units.length_in_cm = find_number(file,
                                   {{"Parameters", "UnitLength_in_cm"},
                                    {"Header", "UnitLength_in_cm"},
                                    {"Units", "UnitLength_in_cm"},
                                    {"Units", "Unit length in cgs (U_L)"}},
                                   0);
  units.mass_in_g = find_number(file,
                                {{"Parameters", "UnitMass_in_g"},
                                 {"Header", "UnitMass_in_g"},
                                 {"Units", "UnitMass_in_g"},
                                 {"Units", "Unit mass in cgs (U_M)"}},
                                0);
  units.velocity_in_cm_per_s = find_number(file,
                                           {{"Parameters", "UnitVelocity_in_cm_per_s"},
                                            {"Header", "UnitVelocity_in_cm_per_s"},
                                            {"Units", "UnitVelocity_in_cm_per_s"}},
                                           0);
  const double time = file.number("Units", "Unit time in cgs (U_t)").value_or(0);
  if (time > 0) units.velocity_in_cm_per_s = units.length_in_cm / time;
  const bool are_known =
      units.length_in_cm > 0 || units.mass_in_g > 0 || units.velocity_in_cm_per_s > 0;
  return are_known ? units : read_units_of_datasets(file);
}

namespace {

std::string group_name(std::size_t type) {
  return fmt::format("PartType{}", type);
}

const char* columns_of(const Hdf5Dataset& dataset) {
  if (!dataset.is_number()) return "columns that are no numbers";
  return dataset.values_per_row() == 1 ? "column" : "columns";
}

[[noreturn]] void throw_no_positions(const Hdf5File& file, const std::string& group,
                                     std::uint64_t count,
                                     const std::vector<Hdf5Dataset>& datasets) {
  std::vector<std::string> labels;
  for (const Hdf5Dataset& dataset : datasets) {
    const bool are_positions = canonical_field_name(dataset.label()) == "position";
    labels.push_back(are_positions ? fmt::format("{} of {} {}", dataset.label(),
                                                 dataset.values_per_row(), columns_of(dataset))
                                   : dataset.label());
  }
  throw DataError(fmt::format(
      "{}: no positions: the header counts {} particles of {}, which has {}; expected a dataset "
      "Coordinates with three columns of numbers: the file is incomplete or no snapshot, or name "
      "them, as in read.columns = {{x = \"{}/Coordinates:1\", y = ...}}",
      file.path().string(), count, group,
      labels.empty() ? "no datasets" : fmt::format("only {}", fmt::join(labels, ", ")), group));
}

// The positions of a type; null where it has none.
const Hdf5Dataset* find_positions(const std::vector<Hdf5Dataset>& datasets) {
  const auto found = std::find_if(datasets.begin(), datasets.end(), [](const Hdf5Dataset& dataset) {
    return canonical_field_name(dataset.label()) == "position" && dataset.is_number() &&
           !dataset.shape.empty() && dataset.values_per_row() == 3;
  });
  return found == datasets.end() ? nullptr : &*found;
}

bool have_rows(const std::vector<Hdf5Dataset>& datasets) {
  return std::any_of(datasets.begin(), datasets.end(), [](const Hdf5Dataset& dataset) {
    return !dataset.shape.empty() && dataset.rows() > 0;
  });
}

void set_count(GadgetHeader& header, std::size_t type, std::uint64_t count) {
  const std::size_t types = std::max(header.counts.size(), type + 1);
  header.counts.resize(types, 0);
  header.total_counts.resize(types, 0);
  header.total_counts_high.resize(types, 0);
  header.table_masses.resize(types, 0);
  header.counts[type] = count;
}

void leave_out(GadgetHeader& header, std::size_t type) {
  if (type >= header.counts.size()) return;
  header.counts[type] = header.total_counts[type] = header.total_counts_high[type] = 0;
}

std::vector<Hdf5Dataset> datasets_of(const Hdf5File& file, const std::string& group) {
  return file.has(group) ? file.datasets(group) : std::vector<Hdf5Dataset>();
}

constexpr std::size_t more_types_than_any_code = 32;

}  // namespace

void count_rows_without_header(const Hdf5File& file, GadgetHeader& header,
                               std::vector<std::string>& notes) {
  if (header.particles() > 0 || header.files > 1) return;
  for (std::size_t type = 0; type < more_types_than_any_code; ++type) {
    if (!file.has(group_name(type))) continue;
    const std::vector<Hdf5Dataset> datasets = file.datasets(group_name(type));
    const Hdf5Dataset* const positions = find_positions(datasets);
    if (positions != nullptr) set_count(header, type, positions->rows());
  }
  if (header.particles() == 0) return;
  std::fill(header.total_counts.begin(), header.total_counts.end(), 0);
  std::fill(header.total_counts_high.begin(), header.total_counts_high.end(), 0);
  notes.push_back(
      "the header counts no particles; their numbers are those of the rows of the positions");
}

void leave_out_tracers(const Hdf5File& file, GadgetHeader& header,
                       std::vector<std::string>& notes) {
  for (std::size_t type = 0; type < header.counts.size(); ++type) {
    const std::string group = group_name(type);
    const bool are_tracers = header.counts[type] > 0 && file.has(group + "/TracerID") &&
                             !file.has(group + "/Coordinates");
    if (!are_tracers) continue;
    notes.push_back(fmt::format("the tracers of {} are left out: they have no positions", group));
    leave_out(header, type);
  }
}

void count_rows_of_positions(const Hdf5File& file, GadgetHeader& header,
                             std::vector<std::string>& notes) {
  std::optional<std::size_t> without_positions;
  const GadgetHeader stated = header;
  for (std::size_t type = 0; type < more_types_than_any_code; ++type) {
    const std::uint64_t count = type < stated.counts.size() ? stated.counts[type] : 0;
    const std::string group = group_name(type);
    if (file.has(group + "/TracerID") && count == 0) continue;
    const std::vector<Hdf5Dataset> datasets = datasets_of(file, group);
    const Hdf5Dataset* const positions = find_positions(datasets);
    if (positions == nullptr) {
      if (count == 0 && !have_rows(datasets)) continue;
      if (!without_positions) without_positions = type;
      leave_out(header, type);
      notes.push_back(
          fmt::format("{} is left out: the header counts {} particles, but {}", group, count,
                      file.has(group) ? "it has no positions" : "there is no such group"));
    } else if (positions->rows() != count) {
      notes.push_back(
          fmt::format("the header counts {} particles of type {}, but {} has {} rows: these count",
                      count, type, positions->path, positions->rows()));
      set_count(header, type, positions->rows());
    }
  }
  if (header.particles() > 0 || !without_positions) return;
  const std::size_t type = *without_positions;
  throw_no_positions(file, group_name(type), type < stated.counts.size() ? stated.counts[type] : 0,
                     datasets_of(file, group_name(type)));
}

}  // namespace splotchcl
