#include <gtest/gtest.h>

#include "formats/hdf5/hdf5_values.h"
#include "map/gas.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

// Maps of files with the header that GIZMO writes, against numbers worked out by hand.
namespace splotchcl {
namespace {

using test::Hdf5Output;
using test::write_attribute;
using test::write_values;

// One particle of mass 2, velocity 3 and internal energy 1e8, in the middle of a pixel.
class MapUnitsOfGizmo : public ::testing::Test {
 protected:
  void write(const std::vector<std::pair<std::string, double>>& header) const {
    const Hdf5Output file = test::create_hdf5(path_);
    test::make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {1, 0, 0, 0, 0, 0});
    write_attribute(file, "Header", "GIZMO_version", {2022});
    for (const auto& [name, value] : header)
      write_attribute(file, "Header", name, {value});
    write_values(file, "PartType0/Coordinates", {0, 0, 0}, 3);
    write_values(file, "PartType0/Velocities", {0, 0, -3}, 3);
    write_values(file, "PartType0/Masses", {2});
    write_values(file, "PartType0/SmoothingLength", {0.01});
    write_values(file, "PartType0/InternalEnergy", {1e8});
  }
  double map(const std::string& quantity, const std::string& unit) const {
    Scene scene = test::map_scene();
    scene.image.width = scene.image.height = 1;
    scene.map.width = 1;
    scene.map.quantity = quantity;
    scene.map.unit = unit;
    return static_cast<double>(test::map_of(scene, *open_snapshot(path_)).values[0]);
  }
  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snapshot_000.hdf5";
};

// A column of 2e10 Msun/h in (0.5 kpc/h)^2 at h = 0.7 is 2e10 * 0.7 / 0.25 Msun/kpc^2, and GIZMO
// writes velocities over the root of the scale factor.
TEST_F(MapUnitsOfGizmo, InABoxAreComovingAndHaveTheHubbleParameter) {
  write({{"ComovingIntegrationOn", 1},
         {"Time", 0.5},
         {"Redshift", 1},
         {"Omega_Matter", 0.3},
         {"Omega_Lambda", 0.7},
         {"HubbleParam", 0.7},
         {"UnitLength_In_CGS", 3.0856775814913673e21 / 0.7},
         {"UnitMass_In_CGS", 1.988409870698051e43 / 0.7},
         {"UnitVelocity_In_CGS", 1e5}});
  EXPECT_NEAR(map("surface_density", "Msun/kpc^2") / 5.6e10, 1, 1e-6);
  EXPECT_NEAR(map("line_of_sight_velocity", "km/s"), 3 * std::sqrt(0.5), 1e-6);
}

// pc, Msun and m/s: 2 Msun/pc^2 = 2 * 1.98841e33 / (3.08568e18)^2 g/cm^2. 1e8 (m/s)^2 are
// 1e12 (cm/s)^2, and ionized gas has mu = 4 / (8 - 5 * 0.24) = 0.588: T = 2/3 1e12 mu m_p / k_B.
TEST_F(MapUnitsOfGizmo, OfACloudAreTheHeaders) {
  write({{"ComovingIntegrationOn", 0},
         {"Time", 0.01},
         {"Redshift", 0},
         {"HubbleParam", 1},
         {"UnitLength_In_CGS", 3.085678e18},
         {"UnitMass_In_CGS", 1.989e33},
         {"UnitVelocity_In_CGS", 100}});
  EXPECT_NEAR(map("surface_density", "g/cm^2") / 4.1767147e-4, 1, 2e-6);
  EXPECT_NEAR(map("line_of_sight_velocity", "km/s"), 0.003, 1e-8);
  EXPECT_NEAR(map("temperature", "K") / 4750.883, 1, 2e-6);
}

}  // namespace
}  // namespace splotchcl
