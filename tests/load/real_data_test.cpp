// Selections and derived fields of real snapshots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "load/particles.h"
#include "paths.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

std::unique_ptr<Snapshot> open_real(const std::string& name) {
  const std::filesystem::path path = data_folder() / name;
  return std::filesystem::exists(path) ? open_snapshot(path) : nullptr;
}

TEST(RealSelection, DividesTheGasOfACosmologicalBox) {
  const auto snapshot = open_real("lcdm/fmt2_snapshot_006");
  if (!snapshot) GTEST_SKIP() << "no lcdm in " << data_folder();
  Component hot = gas(), rest = gas();
  hot.select.where = {"temperature > 1e5 or density > 1e-5"};
  hot.select.sphere_center = Vec3{{25000, 25000, 25000}};
  hot.select.sphere_radius = 20000;
  rest.exclude = hot.select;
  const std::size_t hot_count = load(hot, *snapshot).particles.count;
  EXPECT_GT(hot_count, 100u);
  EXPECT_EQ(hot_count + load(rest, *snapshot).particles.count, 32768u);
}

TEST(RealSelection, FindsEveryOtherOfIdsThatSinglePrecisionCannotHold) {
  const auto snapshot = open_real("gassphere_id64/fmt2_snapshot_001");
  if (!snapshot) GTEST_SKIP() << "no gassphere_id64 in " << data_folder();
  const splotchcl::test::TemporaryFolder folder;
  const std::vector<std::uint64_t> ids = snapshot->read_ids(0);
  ASSERT_GE(*std::min_element(ids.begin(), ids.end()), 1ull << 33);
  {
    std::ofstream list(folder / "ids.txt");
    for (std::size_t i = 0; i < ids.size(); i += 2)
      list << ids[i] << "\n";
  }
  Component component = gas();
  component.select.id_file = (folder / "ids.txt").string();
  const Column all = snapshot->read(0, "position");
  const Particles drawn = load(component, *snapshot).particles;
  ASSERT_EQ(drawn.count, (ids.size() + 1) / 2);
  for (std::size_t i = 0; i < drawn.count; ++i)
    ASSERT_EQ(drawn.position[3 * i], all[6 * i]) << i;
}

TEST(RealTemperature, OfACosmologicalBoxIsThatOfIntergalacticGas) {
  const auto snapshot = open_real("lcdm/fmt2_snapshot_006");
  if (!snapshot) GTEST_SKIP() << "no lcdm in " << data_folder();
  Component component = gas();
  component.color = {"temperature", Scaling::log, {}, {}};
  component.color.percentiles = {0, 100};
  const ScalarMap map = load(component, *snapshot).color;
  // Adiabatic gas without heating: from what is left of the early universe's warmth to what
  // falls into the largest cluster of so small a box.
  EXPECT_GT(map.minimum, -3);
  EXPECT_GT(map.maximum, 6);
  EXPECT_LT(map.maximum, 8.5);
}

TEST(ComponentExamples, AreScenesWithPalettesThatExist) {
  for (const char* name : {"cluster.toml", "planted_galaxy.toml"}) {
    const Scene scene = read_scene_file(source_folder() / "examples" / name);
    EXPECT_GE(scene.components.size(), 3u) << name;
    for (const Component& component : scene.components)
      EXPECT_NO_THROW(load_palette(component.palette)) << name;
  }
}

}  // namespace
}  // namespace splotchcl::test
