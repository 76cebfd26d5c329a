// Which particles a component draws.
#include "formula/selection.h"

#include "load/component_rows.h"
#include "load/particles.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Masses of gas_row are 1, 2, 3, ...: they tell which particles were drawn.
std::vector<float> drawn(const Component& component, const Snapshot& snapshot = gas_row()) {
  return values(load(component, snapshot).particles.weight);
}

Component selecting(const std::vector<std::string>& where) {
  Component component = gas();
  component.select.where = where;
  return component;
}

INSTANTIATE_TEST_SUITE_P(Selection, ComponentKeys,
                         ::testing::ValuesIn(component_rows("select/selection.rows")),
                         name_of_component_row);

TEST(Selection, OfSeveralTypesTakesFromEach) {
  NumberedSnapshot snapshot = gas_row();
  snapshot.add(4, "position", {0, 0, 0, 1, 0, 0}, 3);
  snapshot.add(4, "smoothing_length", {1, 1});
  snapshot.add(4, "mass", {20, 3});
  Component component = selecting({"mass > 5"});
  component.types = {4, 0};
  EXPECT_THAT(drawn(component, snapshot), ElementsAre(20, 6));
}

TEST(Selection, FindsSizesAmongAllParticlesNotOnlyTheSelected) {
  MemorySnapshot snapshot;
  std::vector<float> position, mass;
  for (int i = 0; i < 1000; ++i) {
    position.insert(position.end(), {static_cast<float>(i % 10), static_cast<float>(i / 10 % 10),
                                     static_cast<float>(i / 100)});
    mass.push_back(static_cast<float>(i));
  }
  snapshot.add(0, "position", position, 3);
  snapshot.add(0, "mass", mass);
  const Particles particles = load(selecting({"mass == 555"}), snapshot).particles;
  ASSERT_EQ(particles.count, 1u);
  // On a unit grid: see LoadFrameSize.
  EXPECT_NEAR(particles.smoothing_length[0], std::sqrt(6.0f), 1e-6);
}

TEST(Selection, IsMadeOnceForAllFrames) {
  const NumberedSnapshot snapshot = gas_row();
  const Component component = selecting({"mass > 3"});
  const Particles first = load(component, snapshot).particles;
  const std::size_t reads = snapshot.fields_read().size();
  EXPECT_EQ(load(component, snapshot).particles.position.data(), first.position.data());
  EXPECT_EQ(snapshot.fields_read().size(), reads);
}

TEST(Selection, ThatChangesIsMadeAnew) {
  const NumberedSnapshot snapshot = gas_row();
  EXPECT_THAT(drawn(selecting({"mass > 3"}), snapshot), ElementsAre(4, 5, 6));
  EXPECT_THAT(drawn(selecting({"mass > 4"}), snapshot), ElementsAre(5, 6));
  Component component = gas();
  component.exclude.where = {"mass > 3"};
  EXPECT_THAT(drawn(component, snapshot), ElementsAre(1, 2, 3));
}

TEST(Components, AreRefusedBeforeAnythingIsRead) {
  const NumberedSnapshot snapshot = gas_row();
  std::vector<Component> wrong(7, gas());
  wrong[0].exclude.where = {"rank > 1"};
  wrong[1].color.field = "rank";
  wrong[2].intensity.field = "rank";
  wrong[3].size_field = "rank";
  wrong[4].color_vector = "mass";
  wrong[5].palette = "rank";
  wrong[6].absorption_palette = "rank";
  for (Component& component : wrong) {
    component.name = "wrong";
    EXPECT_THROW(load(scene_of({gas(), component}), snapshot), UsageError);
    EXPECT_THAT(snapshot.fields_read(), IsEmpty());
  }
}

// Of six particles of type 4 those of mass 2 and 5 are wind.
NumberedSnapshot stars_and_wind() {
  NumberedSnapshot snapshot;
  std::vector<float> position;
  for (int i = 0; i < 6; ++i)
    position.insert(position.end(), {static_cast<float>(i), 0, 0});
  snapshot.add(4, "position", position, 3);
  snapshot.add(4, "smoothing_length", {1, 1, 1, 1, 1, 1});
  snapshot.add(4, "mass", {1, 2, 3, 4, 5, 6});
  snapshot.add(4, "GFM_StellarFormationTime", {0.25F, -0.5F, 0.5F, 0.75F, 0, 1});
  return snapshot;
}

Component of_stars(const std::vector<std::string>& where = {}) {
  Component component = selecting(where);
  component.types = {4};
  return component;
}

TEST(Wind, IsNotDrawnAmongTheStarsAndSaid) {
  EXPECT_THAT(drawn(of_stars(), stars_and_wind()), ElementsAre(1, 3, 4, 6));
  EXPECT_THAT(drawn(of_stars({"mass > 2"}), stars_and_wind()), ElementsAre(3, 4, 6));
  EXPECT_THAT(notes_of(of_stars(), stars_and_wind()), Contains(HasSubstr("wind among the stars")));
}

TEST(Wind, IsDrawnByAConditionOnItsTime) {
  EXPECT_THAT(drawn(of_stars({"GFM_StellarFormationTime <= 0"}), stars_and_wind()),
              ElementsAre(2, 5));
  EXPECT_THAT(drawn(of_stars({"GFM_StellarFormationTime < 2"}), stars_and_wind()),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

std::string numpy_header(const std::string& type, int count) {
  std::string header = "{'descr': " + type + ", 'fortran_order': False, 'shape': (" +
                       std::to_string(count) + ",), }";
  header.resize(117, ' ');
  return std::string("\x93NUMPY\1\0v\0", 10) + header + "\n";
}

class SelectionByIds : public ::testing::Test {
 protected:
  Component listing(const std::string& text) {
    const std::string path = (folder_ / "ids.txt").string();
    std::ofstream(path) << text;
    Component component = gas();
    component.select.id_file = path;
    return component;
  }
  const splotchcl::test::TemporaryFolder folder_;
};

TEST_F(SelectionByIds, TellsApartWhatSinglePrecisionCannot) {
  EXPECT_THAT(drawn(listing("1152921504606846977\n1152921504606846980\n")), ElementsAre(2, 5));
}

TEST_F(SelectionByIds, AllowsCommentsBlankLinesAndAnyOrder) {
  EXPECT_THAT(drawn(listing("# bound to halo 3\r\n1152921504606846980  # the last\n\n"
                            "\t1152921504606846976\n1152921504606846980")),
              ElementsAre(1, 5));
}

TEST_F(SelectionByIds, AllowsTheMarkThatEditorsBeginTextsWith) {
  EXPECT_THAT(drawn(listing("\xef\xbb\xbf"
                            "1152921504606846980\n")),
              ElementsAre(5));
}

TEST_F(SelectionByIds, TakesAnArrayOfNumpy) {
  std::string bytes = numpy_header("'<u8'", 2);
  for (const std::uint64_t id : {(1ull << 60) + 4, (1ull << 60) + 1}) {
    for (int byte = 0; byte < 8; ++byte)
      bytes += static_cast<char>(id >> (8 * byte) & 255);
  }
  EXPECT_THAT(drawn(listing(bytes)), ElementsAre(2, 5));
}

TEST_F(SelectionByIds, RefusesMasks) {
  std::string bytes = numpy_header("'|b1'", 2);
  bytes += {0, 1};
  EXPECT_THAT(refusal(listing(bytes), gas_row()), HasSubstr("save ids[mask]"));
  EXPECT_THAT(refusal(listing("0\n1\n1\n0\n1\n"), gas_row()),
              AllOf(HasSubstr("2 zeros and 3 ones"), HasSubstr("save ids[mask]")));
}

TEST_F(SelectionByIds, TakesWholeNumbersAsSavetxtWritesThem) {
  NumberedSnapshot snapshot = gas_row();
  snapshot.number(0, {2000000000, 2000000001, 9007199254740991, 3, 4, 5});
  EXPECT_THAT(drawn(listing("2.000000001000000000e+09\n9.007199254740991000e+15\n"), snapshot),
              ElementsAre(2, 3));
  EXPECT_THAT(refusal(listing("12\n9.007199254740992e+15\n"), gas_row()), HasSubstr("fmt=\"%d\""));
}

TEST_F(SelectionByIds, RefusesAnArrayOfOtherNumbers) {
  const double half = 0.5;
  const std::string bytes =
      numpy_header("'<f8'", 1) + std::string(reinterpret_cast<const char*>(&half), sizeof half);
  EXPECT_THAT(refusal(listing(bytes), gas_row()), HasSubstr("not an array of whole numbers"));
}

TEST_F(SelectionByIds, MayBeExcluded) {
  Component component = listing("1152921504606846976\n");
  component.exclude.id_file = component.select.id_file;
  component.select.id_file = "";
  EXPECT_THAT(drawn(component), ElementsAre(2, 3, 4, 5, 6));
}

TEST_F(SelectionByIds, RefusesWhatIsNoIdWithItsLine) {
  for (const char* text : {"12\nhalo\n", "12\n-3\n", "12\n1.5\n", "12\n18446744073709551616\n",
                           "12\n1 2\n", "12\n0x1f\n"}) {
    EXPECT_THAT(refusal(listing(text), gas_row()), HasSubstr("ids.txt:2: found")) << text;
  }
}

TEST_F(SelectionByIds, RefusesAnEmptyListAndAMissingOne) {
  EXPECT_THAT(refusal(listing("# none\n"), gas_row()), HasSubstr("found no identifier"));
  Component component = gas();
  component.select.id_file = (folder_ / "lost.txt").string();
  EXPECT_THAT(refusal(component, gas_row()), HasSubstr("lost.txt: cannot be opened"));
}

TEST(Conditions, AreRefusedWhereTheyAreNone) {
  for (const char* text : {"", "mass", "mass >", "> 3", "mass = 3", "mass => 3", "mass > 3 and",
                           "and mass > 3", "mass > 3 and or u < 2", "mass > 3 or", "or mass > 3",
                           "3 < mass < 4", "mass > 1e999", "mass > 3 or mass"}) {
    EXPECT_THROW(parse_condition(text, "where"), UsageError) << text;
  }
}

TEST(Conditions, MayHaveBlanksAndNamesWithThem) {
  const Formula condition = parse_condition("  mass table>=  -1.5e-3 or z != 0 ", "where");
  EXPECT_THAT(condition.fields(), ElementsAre("mass table", "z"));
  EXPECT_EQ(condition.parts().back().operation, Operation::either);
  EXPECT_THROW(parse_condition("mass table>=  -1.5e-3 or\tz != 0", "where"), UsageError)
      << "a tab is no blank around or";
}

TEST(Selection, TakesColorsFromFormulas) {
  Component component = gas();
  component.color.field = "log10(mass * internal_energy) + x";
  const std::vector<float> colors = values(load(component, gas_row()).particles.color);
  Component masses = gas(), energies = gas();
  masses.color.field = "mass";
  energies.color.field = "internal_energy";
  const std::vector<float> m = values(load(masses, gas_row()).particles.color),
                           u = values(load(energies, gas_row()).particles.color);
  ASSERT_EQ(colors.size(), 6U);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double expected = std::log10(double(m[i]) * double(u[i])) + double(i);
    EXPECT_FLOAT_EQ(colors[i], static_cast<float>(expected));
  }
}

TEST(Selection, ReadsOnlyWhatFormulasName) {
  const MemorySnapshot snapshot = gas_row();
  Component component = selecting({"mass > 1 && mass < 4"});
  component.color.field = "2 * density";
  load(component, snapshot);
  EXPECT_THAT(snapshot.fields_read(), Not(Contains("internal_energy")));
}

}  // namespace
}  // namespace splotchcl::test
