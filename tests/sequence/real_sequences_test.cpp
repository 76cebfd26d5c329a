// Real runs: a snapshot that was left out is predicted from its neighbours.
#include <gtest/gtest.h>

#include <cmath>

#include "paths.h"
#include "sequence/interpolated_snapshot.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

const std::filesystem::path data = test::data_folder();

std::shared_ptr<const SequenceMember> open(const std::string& name) {
  return std::make_shared<SequenceMember>(open_snapshot(data / name));
}

double time_of(const SequenceMember& member) {
  const SnapshotInfo& info = member.info();
  return info.cosmology ? info.cosmology->scale_factor : info.time;
}

// The root mean square distance between predicted and real positions of one type.
double miss(const std::string& before, const std::string& left_out, const std::string& after,
            int type, Interpolation interpolation) {
  const auto first = open(before), real = open(left_out), second = open(after);
  const double fraction = (time_of(*real) - time_of(*first)) / (time_of(*second) - time_of(*first));
  SequenceSettings settings;
  settings.interpolation = interpolation;
  const InterpolatedSnapshot predicted(make_pair(first, second, settings), fraction);
  const IdMatch match = match_ids(predicted.read_ids(type), real->read_ids(type));
  const Column at = predicted.read(type, "position"), is = real->read(type, "position");
  const double box = real->info().box_size.value_or(1e30).longest();
  double sum = 0;
  for (std::size_t i = 0; i < match.place_in_second.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = static_cast<double>(at[3 * i + axis]) -
                       static_cast<double>(is[3 * match.place_in_second[i] + axis]);
      sum += std::pow(d - box * std::round(d / box), 2);
    }
  }
  return std::sqrt(sum / static_cast<double>(match.in_common));
}

class RealSequences : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real snapshots in " << data;
  }
};

TEST_F(RealSequences, OfTheUniverseAreBetterPredictedWithVelocities) {
  for (const int type : {0, 1}) {
    const auto predict = [type](Interpolation interpolation) {
      return miss("lcdm/fmt2_snapshot_004", "lcdm/fmt2_snapshot_005", "lcdm/fmt2_snapshot_006",
                  type, interpolation);
    };
    const double linear = predict(Interpolation::linear);
    const double hermite = predict(Interpolation::hermite);
    RecordProperty("linear_" + std::to_string(type), std::to_string(linear));
    RecordProperty("hermite_" + std::to_string(type), std::to_string(hermite));
    EXPECT_LT(hermite, linear) << "type " << type;
  }
}

TEST_F(RealSequences, OfTwoGalaxiesMatchEveryParticle) {
  const auto pair = make_pair(open("galaxy_collision/snapshot_000.hdf5"),
                              open("galaxy_collision/snapshot_005.hdf5"), SequenceSettings());
  EXPECT_EQ(pair->matches.at(1)->in_common, 40000U);
  EXPECT_EQ(pair->matches.at(2)->in_common, 20000U);
  EXPECT_TRUE(pair->notes.empty());
}

}  // namespace
}  // namespace splotchcl
