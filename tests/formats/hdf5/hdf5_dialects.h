#pragma once

#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {

// Two cells or particles of gas in a group Header and PartType0.
class Hdf5Dialects : public ::testing::Test {
 protected:
  Hdf5Output create(const std::vector<double>& counts = {2, 0, 0, 0, 0, 0}) const {
    Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", counts);
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    return file;
  }
  // Of SWIFT, in Mpc, 1e10 solar masses and some gigayears.
  Hdf5Output create_swift() const {
    Hdf5Output file = create();
    make_group(file, "Code");
    write_text(file, "Code", "Code", "SWIFT");
    make_group(file, "Units");
    write_attribute(file, "Units", "Unit length in cgs (U_L)", {3.08567758e24});
    write_attribute(file, "Units", "Unit mass in cgs (U_M)", {1.98841e43});
    write_attribute(file, "Units", "Unit time in cgs (U_t)", {3.08567758e19});
    return file;
  }
  // Of mass, length, time and current.
  static void state_powers(const Hdf5Output& file, const std::string& dataset,
                           const std::vector<double>& powers) {
    const std::vector<const char*> names = {"U_M exponent", "U_L exponent", "U_t exponent",
                                            "U_I exponent"};
    for (std::size_t i = 0; i < names.size(); ++i)
      write_attribute(file, dataset, names[i], {powers[i]});
  }
  // Of a field of gas.
  std::string unit_of(const char* field) const {
    const auto snapshot = open_snapshot(path_);
    return find_field(*snapshot->info().find_type(0), field)->unit;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap.hdf5";
};

}  // namespace splotchcl::test
