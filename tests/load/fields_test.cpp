// Fields that follow from others, and the ranges of fields.
#include "load/derived_fields.h"
#include "load/particles.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Component colored_by(const std::string& field) {
  Component component = gas();
  component.color.field = field;
  return component;
}

std::vector<float> field(const std::string& name, const Snapshot& snapshot) {
  return values(load(colored_by(name), snapshot).particles.color);
}

// One particle, whose internal energy is said in this unit.
class GasWithUnit : public MemorySnapshot {
 public:
  GasWithUnit(const std::string& format, const std::string& unit) {
    add(0, "position", {0, 0, 0}, 3);
    add(0, "smoothing_length", {1});
    add(0, "mass", {1});
    add(0, "internal_energy", {1000});
    changed_ = MemorySnapshot::info();
    changed_.format = format;
    changed_.types[0].fields.back().unit = unit;
    changed_.hubble_parameter = 0.5;
    changed_.cosmology = Cosmology();
    changed_.cosmology->scale_factor = 0.25;
  }
  const SnapshotInfo& info() const override { return changed_; }

 private:
  SnapshotInfo changed_;
};

// (gamma - 1) u m_p / k_B of 1000 (km/s)^2, in kelvin, for a mean molecular weight of 1.
const double kelvin_of_1000 = 2.0 / 3 * 1e13 * 1.67262192369e-24 / 1.380649e-16;
// Hydrogen and helium, all ionised: per nucleon X * 2 + (1 - X) / 4 * 3 particles.
const double ionised_weight = 1 / (0.76 * 2 + 0.24 / 4 * 3);

TEST(Temperature, OfIonisedGasFollowsFromInternalEnergy) {
  const GasWithUnit snapshot("Gadget format 2", "");
  EXPECT_NEAR(field("temperature", snapshot)[0] / (kelvin_of_1000 * ionised_weight), 1, 1e-6);
  EXPECT_THAT(notes_of(colored_by("temperature"), snapshot),
              Contains(HasSubstr("taken to be in (km/s)^2, Gadget's unit, and all gas to be "
                                 "ionised")));
}

TEST(Temperature, FollowsFromElectronsPerHydrogenWhereTheyAreKnown) {
  NumberedSnapshot snapshot = gas_row(2);
  snapshot.add(0, "electron_abundance", {0, 1.157895f});  // neutral, and fully ionised
  const Column energy = snapshot.read(0, "internal_energy");
  const Column kelvin = temperatures(energy, snapshot.read(0, "electron_abundance"), 1e10, 2);
  const double neutral_weight = 1 / (0.76 + 0.24 / 4);
  EXPECT_NEAR(kelvin[0] / (kelvin_of_1000 / 1000 * neutral_weight), 1, 1e-6);
  EXPECT_NEAR(kelvin[1] / (kelvin_of_1000 / 100 * ionised_weight), 1, 1e-6);
}

TEST(Temperature, TakesTheUnitThatTheFileSays) {
  const auto kelvin = [](const std::string& unit) {
    return static_cast<double>(field("temperature", GasWithUnit("SWIFT HDF5", unit))[0]) /
           (kelvin_of_1000 * ionised_weight);
  };
  EXPECT_NEAR(kelvin("(km/s)^2"), 1, 1e-6);
  EXPECT_NEAR(kelvin("(cm/s)^2"), 1e-10, 1e-16);
  EXPECT_NEAR(kelvin("(3e+06 cm/s)^2"), 900, 1e-3);
  EXPECT_NEAR(kelvin("(km/s)^2 a^-2"), 16, 1e-5);
  EXPECT_NEAR(kelvin("(km/s)^2 h a"), 0.125, 1e-6);
  EXPECT_NEAR(kelvin("km^2/s^2"), 1, 1e-6);
  EXPECT_NEAR(kelvin("erg/g"), 1e-10, 1e-16);
  EXPECT_NEAR(kelvin("J kg^-1"), 1e-6, 1e-12);
}

TEST(Temperature, OfGadgetsDescendantsIsInTheSameUnitWhereTheFileSaysNone) {
  for (const char* const format : {"AREPO HDF5", "GIZMO HDF5"}) {
    EXPECT_NEAR(
        field("temperature", GasWithUnit(format, ""))[0] / (kelvin_of_1000 * ionised_weight), 1,
        1e-6);
  }
}

TEST(Temperature, IsRefusedWhereTheUnitIsNotKnown) {
  EXPECT_THAT(refusal(colored_by("temperature"), GasWithUnit("Tipsy", "")),
              HasSubstr("needs the unit of internal_energy, but memory has none"));
  EXPECT_THAT(refusal(colored_by("temperature"), GasWithUnit("SWIFT HDF5", "erg")),
              HasSubstr("has \"erg\""));
}

TEST(SmoothingLengths, ThatAreAllZeroAreFound) {
  NumberedSnapshot snapshot;
  std::vector<float> position;
  for (int i = 0; i < 100; ++i)
    position.insert(position.end(), {static_cast<float>(i), 0, 0});
  snapshot.add(0, "position", position, 3);
  snapshot.add(0, "smoothing_length", std::vector<float>(100, 0));
  // Of the one at the end of the row, to its 64th neighbour.
  EXPECT_EQ(load(gas(), snapshot).particles.smoothing_length[0], 64);
  EXPECT_THAT(notes_of(gas(), snapshot), Contains(HasSubstr("are all 0: they do not count")));
}

TEST(DerivedFields, AreMadeOnceForAllFrames) {
  const NumberedSnapshot snapshot = gas_row();
  const Particles first = load(colored_by("velocity_y"), snapshot).particles;
  EXPECT_EQ(load(colored_by("velocity_y"), snapshot).particles.color.data(), first.color.data());
}

TEST(DerivedFields, AreListedForATypeUnlessTheFileHasThem) {
  NumberedSnapshot snapshot = gas_row();
  EXPECT_THAT(derivable_fields(snapshot.info().types[0]),
              ElementsAre("density", "temperature", "speed", "radius", "position_x", "position_y",
                          "position_z", "velocity_x", "velocity_y", "velocity_z"));
  snapshot.add(0, "temperature", std::vector<float>(6, 1));
  EXPECT_THAT(derivable_fields(snapshot.info().types[0]), Not(Contains("temperature")));
}

TEST(DerivedFields, AreForgottenWhenFramesNoLongerUseThem) {
  const NumberedSnapshot snapshot = gas_row();
  load(colored_by("velocity_y"), snapshot);
  const auto velocity_reads = [&snapshot] {
    const auto& reads = snapshot.fields_read();
    return std::count(reads.begin(), reads.end(), "velocity");
  };
  for (int frame = 0; frame < 5; ++frame)
    load(gas(), snapshot);
  EXPECT_EQ(velocity_reads(), 1);
  load(colored_by("velocity_y"), snapshot);
  EXPECT_EQ(velocity_reads(), 2);
}

TEST(DerivedFields, TellWhatTheyRestOnInEveryFrame) {
  const GasWithUnit snapshot("Gadget format 2", "");
  const std::vector<std::string> first = notes_of(colored_by("temperature"), snapshot);
  EXPECT_EQ(first.size(), 2u) << "the temperature, and that it is the same for all";
  EXPECT_EQ(notes_of(colored_by("temperature"), snapshot), first);
}

ScalarMap range(std::optional<std::array<double, 2>> percentiles, Scaling scaling) {
  MemorySnapshot many;
  std::vector<float> position(3 * 1001, 0.0f), h(1001, 1.0f), energy;
  for (int i = 0; i <= 1000; ++i)
    energy.push_back(static_cast<float>(i));
  many.add(0, "position", position, 3);
  many.add(0, "smoothing_length", h);
  many.add(0, "internal_energy", energy);
  Component component = colored_by("internal_energy");
  component.color.scaling = scaling;
  component.color.percentiles = percentiles;
  return load(component, many).color;
}

TEST(Percentiles, AreThoseThatTheSceneGives) {
  const ScalarMap quarter = range({{25, 90}}, Scaling::linear);
  EXPECT_NEAR(quarter.minimum, 250, 1e-9);
  EXPECT_NEAR(quarter.maximum, 900, 1e-9);
  const ScalarMap all = range({{0, 100}}, Scaling::linear);
  EXPECT_EQ(all.minimum, 0);
  EXPECT_EQ(all.maximum, 1000);
  const ScalarMap usual = range(std::nullopt, Scaling::linear);
  EXPECT_NEAR(usual.minimum, 5, 1e-9);
  EXPECT_NEAR(usual.maximum, 995, 1e-9);
}

TEST(Percentiles, CountOnlyValuesThatTheScalingHas) {
  EXPECT_EQ(range({{0, 100}}, Scaling::log).minimum, 0) << "of 1, not of 0";
}

TEST(Percentiles, OfTheWholeRangeSeeEveryValueOfManyMillions) {
  std::vector<float> values(5000001, 1.0f);
  values[3000001] = 7;  // between those that are sampled
  values[2000003] = -7;
  MemorySnapshot snapshot;
  snapshot.add(0, "position", std::vector<float>(3 * values.size(), 0.0f), 3);
  snapshot.add(0, "smoothing_length", std::vector<float>(values.size(), 1.0f));
  snapshot.add(0, "density", values);
  Component component = colored_by("density");
  component.color.percentiles = {0, 100};
  const ScalarMap map = load(component, snapshot).color;
  EXPECT_EQ(map.minimum, -7);
  EXPECT_EQ(map.maximum, 7);
}

TEST(ColorVector, IsReadAsItIs) {
  Component component = gas();
  component.color_vector = "velocity";
  const DrawnComponent drawn = load(component, gas_row(2));
  EXPECT_TRUE(drawn.particles.color.is_absent());
  EXPECT_FALSE(drawn.palette.has_own_absorption());
}

TEST(AbsorptionPalette, GivesTheComponentAnAbsorptionOfItsOwn) {
  Component component = colored_by("mass");
  component.palette = "magma";
  component.absorption_palette = "gray";
  const Palette palette = load(component, gas_row()).palette;
  EXPECT_EQ(palette.absorption.front(), (Rgb{0, 0, 0}));
  EXPECT_EQ(palette.absorption.back(), (Rgb{1, 1, 1}));
  EXPECT_NE(palette.emission, palette.absorption);
}

TEST(AbsorptionPalette, ThatIsThePaletteKeepsEProportionalToA) {
  Component component = colored_by("mass");
  component.absorption_palette = component.palette;
  EXPECT_FALSE(load(component, gas_row()).palette.has_own_absorption());
}

}  // namespace
}  // namespace splotchcl::test
