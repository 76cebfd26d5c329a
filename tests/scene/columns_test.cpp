#include <gtest/gtest.h>

#include <memory>

#include "device/counted_column.h"
#include "scene/particle_columns.h"

namespace splotchcl {
namespace {

using test::CountedColumn;

Particles three_particles() {
  Particles particles;
  particles.count = 3;
  particles.position = Column::owning({0, 1, 2, 3, 4, 5, 6, 7, 8});
  particles.weight = Column::owning({10, 11, 12});
  particles.color = Column::uniform(5);
  return particles;
}

TEST(SameColumns, AreThoseInTheSameMemory) {
  const Particles particles = three_particles();
  EXPECT_TRUE(have_same_columns(particles, Particles(particles)));
  EXPECT_FALSE(have_same_columns(particles, three_particles()));
}

TEST(SameColumns, HaveTheSameValueForAll) {
  const Particles particles = three_particles();
  Particles others = particles;
  others.color = Column::uniform(5);
  EXPECT_TRUE(have_same_columns(particles, others));
  others.color = Column::uniform(6);
  EXPECT_FALSE(have_same_columns(particles, others));
  others.color = Column();
  EXPECT_FALSE(have_same_columns(particles, others));
}

TEST(SameColumns, AreMadeByTheSameAndNotMadeForThat) {
  Particles particles = three_particles();
  const auto weights = std::make_shared<const CountedColumn>(particles.weight);
  particles.weight = Column::made_by(weights);
  Particles others = particles;
  others.weight = Column::made_by(weights);
  EXPECT_TRUE(have_same_columns(particles, others));
  others.weight = Column::made_by(std::make_shared<const CountedColumn>(three_particles().weight));
  EXPECT_FALSE(have_same_columns(particles, others));
  EXPECT_EQ(weights->made(), 0u);
}

TEST(PickedParticles, AreMadeAlone) {
  Particles particles = three_particles();
  const auto positions = std::make_shared<const CountedColumn>(particles.position);
  particles.position = Column::made_by(positions);
  const Particles picked = picked_particles(particles, {2, 0});
  ASSERT_EQ(picked.count, 2u);
  EXPECT_EQ(picked.position[1], 7);
  EXPECT_EQ(picked.position[3], 0);
  EXPECT_EQ(picked.weight[1], 10);
  EXPECT_EQ(picked.color.uniform_value(), 5);
  EXPECT_EQ(positions->made(), 6u);
}

}  // namespace
}  // namespace splotchcl
