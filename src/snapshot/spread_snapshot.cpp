#include "splotchcl/spread_snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "ranks/spread_particles.h"
#include "ranks/values.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "snapshot/spread_snapshot_info.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::uint64_t count_of(const SnapshotInfo& info, int type) {
  const ParticleTypeInfo* const known = info.find_type(type);
  return known == nullptr ? 0 : known->count;
}

}  // namespace

// A rank's particles under the names of the whole. Of types of which it has none the columns are
// empty.
class SpreadSnapshot::OwnPart final : public Snapshot {
 public:
  OwnPart(const ArraySnapshot& own, std::shared_ptr<SpreadParticles> spread, SnapshotInfo whole)
      : own_(own), spread_(std::move(spread)), info_(std::move(whole)) {
    for (ParticleTypeInfo& type : info_.types)
      type.count = count_of(own_.info(), type.type);
  }

  void set_first_place(int type, std::uint64_t place) { first_places_[type] = place; }

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override {
    const FieldInfo& info = require_field(info_, type, field);
    if (count_of(info_, type) == 0) return Column::owning({});
    return own_.read(type, info.name);
  }
  std::uint64_t place_in_file(int type, std::uint64_t i) const override {
    return first_places_.at(type) + i;
  }
  Vec3 position_origin() const override { return own_.position_origin(); }
  std::shared_ptr<SpreadParticles> spread() const override { return spread_; }

 private:
  const ArraySnapshot& own_;
  std::shared_ptr<SpreadParticles> spread_;
  SnapshotInfo info_;
  std::map<int, std::uint64_t> first_places_;  // among those of all ranks
};

SpreadSnapshot::SpreadSnapshot(const ArraySnapshot& own, std::shared_ptr<Communicator> ranks)
    : own_(own), ranks_(std::move(ranks)) {
  if (!ranks_) {
    throw UsageError(
        "a snapshot that is spread over ranks: found no communicator, expected one; make it with "
        "splotchcl::ranks_of");
  }
  if (ranks_->size() > 1) spread_ = std::make_shared<SpreadParticles>(ranks_);
  changed();
}

SpreadSnapshot::~SpreadSnapshot() = default;

void SpreadSnapshot::changed() {
  own_.changed();
  memory().forget_own();
  if (!spread_) {
    info_ = own_.info();
    return;
  }
  std::vector<SnapshotPart> parts;
  for (const std::string& text :
       gather_texts(*ranks_, packed({own_.info(), own_.position_origin()})))
    parts.push_back(unpacked(text));
  spread_->agree_on([&] {
    info_ = whole_of(parts);
    info_.format = own_.info().format;
    info_.files = own_.info().files;
  });
  own_part_ = std::make_unique<OwnPart>(own_, spread_, info_);
  own_part_->share_lasting_memory_of(*this);
  for (const ParticleTypeInfo& type : info_.types) {
    std::uint64_t before = 0;
    for (int rank = 0; rank < ranks_->rank(); ++rank)
      before += count_of(parts[static_cast<std::size_t>(rank)].info, type.type);
    own_part_->set_first_place(type.type, before);
  }
}

Column SpreadSnapshot::read(int type, const std::string& field) const {
  if (!spread_) return own_.read(type, field);
  const FieldInfo& info = require_field(info_, type, field);
  return memory().get<Column>(fmt::format("type {}: field {} of all ranks", type, info.name), [&] {
    return spread_->spread(own_part_->read(type, field), count_of(own_part_->info(), type),
                           static_cast<std::size_t>(info.values_per_particle));
  });
}

const Snapshot& SpreadSnapshot::own_part() const {
  if (!own_part_) return *this;
  return *own_part_;
}

}  // namespace splotchcl
