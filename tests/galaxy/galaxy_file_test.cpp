#include <gtest/gtest.h>

#include "galaxy/galaxy_picture.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

std::vector<float> values(const Column& column) {
  return {column.data(), column.data() + column.size()};
}

TEST(GalaxyFile, OurReaderReadsWhatIsWritten) {
  const TemporaryFolder folder;
  const Galaxy galaxy = make_galaxy(DiskPicture().draw(), small_settings());
  write_galaxy(folder / "galaxy.hdf5", galaxy);
  const auto snapshot = open_snapshot(folder / "galaxy.hdf5");
  EXPECT_TRUE(snapshot->info().notes.empty());
  for (const auto& [type, particles] :
       {std::pair(0, &galaxy.gas), std::pair(2, &galaxy.disk), std::pair(3, &galaxy.bulge),
        std::pair(4, &galaxy.clusters)}) {
    const ParticleTypeInfo* const info = snapshot->info().find_type(type);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(info->count, particles->count());
    EXPECT_EQ(values(snapshot->read(type, "position")), particles->position);
    EXPECT_EQ(values(snapshot->read(type, "velocity")), particles->velocity);
    EXPECT_EQ(values(snapshot->read(type, "mass")), particles->mass);
    EXPECT_EQ(values(snapshot->read(type, "smoothing_length")), particles->smoothing_length);
    EXPECT_EQ(values(snapshot->read(type, "Color")), particles->color);
    EXPECT_EQ(values(snapshot->read(type, "OrbitAxis")), particles->orbit_axis);
    EXPECT_EQ(values(snapshot->read(type, "OrbitRadius")), particles->orbit_radius);
  }
  EXPECT_EQ(values(snapshot->read(5, "position")), galaxy.dust.position);
  EXPECT_EQ(values(snapshot->read(5, "Opacity")), galaxy.dust.color);
  EXPECT_EQ(snapshot->read_ids(0).front(), 1u);
  EXPECT_EQ(snapshot->read_ids(2).front(), galaxy.gas.count() + 1);
}

TEST(GalaxyFile, LengthsAndVelocitiesNameTheirUnits) {
  const TemporaryFolder folder;
  write_galaxy(folder / "galaxy.hdf5", make_galaxy(DiskPicture().draw(), small_settings()));
  const auto snapshot = open_snapshot(folder / "galaxy.hdf5");
  const auto unit = [&](const char* field) {
    return find_field(*snapshot->info().find_type(0), field)->unit;
  };
  EXPECT_EQ(unit("position"), "kpc");
  EXPECT_EQ(unit("smoothing_length"), "kpc");
  EXPECT_EQ(unit("OrbitRadius"), "kpc");
  EXPECT_EQ(unit("velocity"), "km/s");
  EXPECT_EQ(unit("mass"), "");
}

TEST(GalaxyFile, NothingIsLeftWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  const Galaxy galaxy = make_galaxy(DiskPicture().draw(), small_settings());
  EXPECT_THROW(write_galaxy(folder / "missing" / "galaxy.hdf5", galaxy), DataError);
  EXPECT_THROW(write_galaxy(folder.path(), galaxy), DataError);
  EXPECT_EQ(folder.count_files(), 0u);
}

}  // namespace
}  // namespace splotchcl::test
