// Several numbers for each particle, as of chemical elements, and numbers that are kept as text.
#include "formats/hdf5/hdf5_dialects.h"
#include "formats/snapshot_checks.h"

namespace splotchcl::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<double> rising(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(static_cast<double>(i));
  return values;
}

TEST_F(Hdf5Dialects, OfGizmosMetalsTheFirstIsTheWholeAndOthersAreElements) {
  write_values(create(), "PartType0/Metallicity", rising(22), 11, H5T_IEEE_F32LE);
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "metallicity")), ElementsAre(0, 11));
  EXPECT_THAT(values_of(snapshot->read(0, "Metallicity.O")), ElementsAre(4, 15));
  EXPECT_THAT(values_of(snapshot->read(0, "Metallicity.Fe")), ElementsAre(10, 21));
}

TEST_F(Hdf5Dialects, SwiftsColumnsHaveTheNamesThatTheFileLists) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/ElementMassFractions", {1, 2, 3, 4, 5, 6, 7, 8}, 4);
    write_lines(file, "SubgridScheme/NamedColumns/ElementMassFractions",
                {"Hydrogen", "Helium", "Carbon", "Oxygen"});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "ElementMassFractions.Oxygen")), ElementsAre(4, 8));
}

TEST_F(Hdf5Dialects, ColumnsWithoutNamesHaveNumbersFromOne) {
  write_values(create(), "PartType0/Extra", {1, 2, 3, 4}, 2);
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "Extra.1")), ElementsAre(1, 3));
  EXPECT_THAT(values_of(snapshot->read(0, "Extra.2")), ElementsAre(2, 4));
}

TEST_F(Hdf5Dialects, EaglesElementsAreInAGroup) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/ElementAbundance/Oxygen", {5, 6});
    write_values(file, "PartType0/ElementAbundance/Iron", {7, 8});
    write_values(file, "PartType0/ElementAbundance/Broken", {7});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "ElementAbundance.Oxygen")), ElementsAre(5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "ElementAbundance.Iron")), ElementsAre(7, 8));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("ElementAbundance.Broken (1)")));
}

TEST_F(Hdf5Dialects, NumbersThatAreKeptAsTextCount) {
  {
    const Hdf5Output file = create();
    write_text(file, "Header", "BoxSize", "100.5");
    write_text(file, "Header", "HubbleParam", " 0.7 ");
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().box_size, 100.5);
  EXPECT_EQ(snapshot->info().hubble_parameter, 0.7);
}

TEST_F(Hdf5Dialects, TextThatIsNoNumberIsIgnoredWithANote) {
  write_text(create(), "Header", "BoxSize", "100 Mpc");
  const auto snapshot = open_snapshot(path_);
  EXPECT_FALSE(snapshot->info().box_size);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("BoxSize is the text \"100 Mpc\"")));
}

}  // namespace
}  // namespace splotchcl::test
