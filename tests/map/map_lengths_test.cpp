#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/gas.h"
#include "map/map_units.h"
#include "splotchcl/error.h"
#include "splotchcl/map.h"

namespace splotchcl {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Of a run at a = 0.5 and h = 0.7.
SnapshotInfo in_comoving_kpc() {
  SnapshotInfo info;
  info.redshift = 1;
  info.hubble_parameter = 0.7;
  ParticleTypeInfo gas;
  gas.type = 0;
  FieldInfo position;
  position.name = "position";
  position.unit = "a kpc/h";
  gas.fields = {position};
  info.types = {gas};
  return info;
}

double length_of(const std::string& text, const SnapshotInfo& info = in_comoving_kpc()) {
  return length_in_snapshot(text, {}, info, 0, "option --width");
}

TEST(MapLength, WithAUnitIsConvertedToTheSnapshots) {
  EXPECT_NEAR(length_of("4Mpc"), 4000 * 0.7 / 0.5, 1e-9);
  EXPECT_NEAR(length_of("4 Mpc"), length_of("4Mpc"), 1e-9);
  EXPECT_NEAR(length_of("4e3kpc"), length_of("4Mpc"), 1e-9);
  EXPECT_NEAR(length_of("-2.5 a kpc/h"), -2.5, 1e-12);
  EXPECT_NEAR(length_of("3.2615637771675 ly"), length_of("1 pc"), 1e-8);
}

TEST(MapLength, OfANumberAloneIsTheSnapshots) {
  EXPECT_EQ(length_of("4000"), 4000);
  EXPECT_EQ(length_of("4000", {}), 4000);
}

TEST(MapLength, HasToBeALength) {
  for (const char* const text : {"4 Msun", "Mpc", "4 parsecs", ""}) {
    EXPECT_THAT([&] { length_of(text); }, ThrowsMessage<UsageError>(HasSubstr("option --width")))
        << text;
  }
}

TEST(MapLength, NeedsTheSnapshotsUnit) {
  SnapshotInfo silent = in_comoving_kpc();
  silent.types[0].fields[0].unit.clear();
  EXPECT_THAT([&] { length_of("4Mpc", silent); },
              ThrowsMessage<UsageError>(HasSubstr("set map.length_unit")));
  MapSettings says;
  says.length_unit = "kpc";
  EXPECT_NEAR(length_in_snapshot("4Mpc", says, silent, 0, "width"), 4000, 1e-9);
}

MapUnits units_of(double width, const MapSettings& settings = {}) {
  return decide_units(settings, in_comoving_kpc(), {0}, MapQuantity::Kind::counts, width);
}

TEST(MapAxes, AreInTheLargestUnitThatTheMapIsAsWideAs) {
  const double kpc = 0.7 / 0.5;  // in the snapshot's lengths
  EXPECT_EQ(units_of(10000 * kpc).length_name, "Mpc");
  EXPECT_NEAR(units_of(10000 * kpc).length_factor, 1e-3 / kpc, 1e-12);
  EXPECT_EQ(units_of(999 * kpc).length_name, "kpc");
  EXPECT_EQ(units_of(2e6 * kpc).length_name, "Gpc");
  EXPECT_EQ(units_of(0.5 * kpc).length_name, "pc");
}

TEST(MapAxes, AreInTheUnitThatIsAskedFor) {
  MapSettings settings;
  settings.axis_unit = "ly";
  EXPECT_EQ(units_of(10000, settings).length_name, "ly");
  settings.axis_unit = "Msun";
  EXPECT_THAT([&] { units_of(1, settings); },
              ThrowsMessage<UsageError>(HasSubstr("key map.axis_unit")));
}

}  // namespace
}  // namespace splotchcl
