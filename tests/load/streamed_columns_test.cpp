// Columns that are too large for memory are made as they are wanted: what is loaded of them has the
// values of columns that are held.
#include "load/derived_fields.h"
#include "load/particles.h"
#include "scene/particle_columns.h"
#include "scene/statistics.h"
#include "splotchcl/load.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr int particles_of_row = 30;

class StreamedSnapshot : public NumberedSnapshot {
 public:
  explicit StreamedSnapshot(const NumberedSnapshot& held) : NumberedSnapshot(held) {}
  Column read(int type, const std::string& field) const override {
    const Column held = NumberedSnapshot::read(type, field);
    if (!held.is_array()) return held;
    const auto copy = [held](std::size_t begin, std::size_t end, float* values) {
      std::copy(held.data() + begin, held.data() + end, values);
    };
    return make_column(held.size(), true, copy);
  }
};

std::vector<float> values_of(const Column& column) {
  if (!column.is_array()) return {column[0]};
  return {column.data(), column.data() + column.size()};
}

NumberedSnapshot two_types() {
  NumberedSnapshot snapshot = gas_row(particles_of_row);
  std::vector<float> position, h(7, 0.25f), mass(7, 2);
  for (int i = 0; i < 7; ++i)
    position.insert(position.end(), {static_cast<float>(i), 1, static_cast<float>(-i)});
  snapshot.add(4, "position", position, 3);
  snapshot.add(4, "smoothing_length", h);
  snapshot.add(4, "mass", mass);
  return snapshot;
}

// Whether positions come to the frame streamed, or as in memory, and the same in all values.
void expect_the_same(const Component& component, bool streamed,
                     const std::optional<double>& wrapped_in = std::nullopt) {
  const NumberedSnapshot held = two_types();
  const StreamedSnapshot large(held);
  Scene scene;
  Camera camera;
  camera.position = {{0, -20, 0}};
  camera.sky = {{0, 0, 1}};
  scene.camera = camera;
  scene.components = {component};
  scene.periodic.wrap = wrapped_in.has_value();
  scene.periodic.box = wrapped_in;
  std::vector<std::string> notes, notes_of_large;
  const DrawnComponent a = load_frame(scene, held, notes).components.front();
  const DrawnComponent b = load_frame(scene, large, notes_of_large).components.front();
  EXPECT_EQ(notes, notes_of_large);
  EXPECT_EQ(is_streamed(b.particles.position), streamed);
  EXPECT_FALSE(is_streamed(a.particles.position));
  EXPECT_EQ(values_of(a.particles.position), values_of(b.particles.position));
  EXPECT_EQ(values_of(a.particles.smoothing_length), values_of(b.particles.smoothing_length));
  EXPECT_EQ(values_of(a.particles.weight), values_of(b.particles.weight));
  EXPECT_EQ(values_of(a.particles.color), values_of(b.particles.color));
  EXPECT_EQ(a.color.minimum, b.color.minimum);
  EXPECT_EQ(a.color.maximum, b.color.maximum);
  EXPECT_EQ(a.reference_column, b.reference_column);
}

TEST(StreamedColumns, StayStreamedInAFrame) {
  expect_the_same(gas(), true);
}

TEST(StreamedColumns, GiveDerivedFields) {
  for (const char* const field : {"speed", "velocity_y", "radius", "density"}) {
    Component component = gas();
    component.color.field = field;
    SCOPED_TRACE(field);
    expect_the_same(component, true);
  }
}

TEST(StreamedColumns, GiveTemperatures) {
  const NumberedSnapshot held = two_types();
  const StreamedSnapshot large(held);
  const auto temperatures_of = [](const Snapshot& snapshot) {
    const Column energy = snapshot.read(0, "internal_energy");
    return temperatures(energy, snapshot.read(0, "mass"), 1e10, energy.size());
  };
  EXPECT_TRUE(is_streamed(temperatures_of(large)));
  EXPECT_EQ(values_of(temperatures_of(large)), values_of(temperatures_of(held)));
}

TEST(StreamedColumns, GiveExtremesAndPercentiles) {
  Component component = gas();
  component.color.field = "internal_energy";
  component.color.percentiles = {{0, 100}};
  expect_the_same(component, true);
  component.color.percentiles = {{10, 90}};
  expect_the_same(component, true);
}

TEST(StreamedColumns, AreJoined) {
  Component component = gas();
  component.types = {0, 4};
  expect_the_same(component, true);
}

TEST(StreamedColumns, ArePlaced) {
  Component component = gas();
  component.placement.angle_degrees = 30;
  component.placement.axis = {{1, 2, 3}};
  component.placement.scale = 2;
  expect_the_same(component, true);
}

TEST(StreamedColumns, AreWrappedAround) {
  expect_the_same(gas(), true, 11);
}

TEST(StreamedColumns, AreHeldWhereParticlesAreSelected) {
  Component component = gas();
  component.select.sphere_center = Vec3{{4, 0, 0}};
  component.select.sphere_radius = 2.5;
  expect_the_same(component, false);
}

TEST(StreamedColumns, AreGatheredInOrder) {
  std::vector<float> values(3 * (2 * streamed_particles + 5));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(i % 1000003);
  const Column held = Column::owning(values);
  const Column large = make_column(values.size(), true, [&](auto begin, auto end, float* out) {
    std::copy(values.begin() + static_cast<std::ptrdiff_t>(begin),
              values.begin() + static_cast<std::ptrdiff_t>(end), out);
  });
  const auto place = [](std::size_t i) { return 1000 * i + i % 7; };
  const std::size_t count = 2 * streamed_particles / 1000;
  EXPECT_EQ(values_of(gather_in_order(held, 3, count, place)),
            values_of(gather_in_order(large, 3, count, place)));
  EXPECT_EQ(gather_in_order(large, 3, count, place)[3 * 400 + 1], values[3 * place(400) + 1]);
}

}  // namespace
}  // namespace splotchcl::test
