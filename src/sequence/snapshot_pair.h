#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "between/id_match.h"
#include "sequence/motion.h"
#include "sequence/sequence_member.h"
#include "sequence/type_path.h"

namespace splotchcl {

// Two snapshots that follow each other, with their particles matched.
class SnapshotPair {
 public:
  // Columns of a type that a snapshot does not have are absent.
  const TypePath& path(int type) const;  // read at the first call

  std::shared_ptr<const SequenceMember> first, second;
  std::map<int, std::shared_ptr<const IdMatch>> matches;  // of every type that either has
  std::optional<Motion> motion;                           // with hermite
  std::vector<std::string> notes;

 private:
  PathEnd path_end(const SequenceMember& member, int type, double rate) const;

  mutable std::mutex mutex_;
  mutable std::map<int, TypePath> paths_;
};

// A column of a member, absent where the member has nothing of the type.
Column read_or_nothing(const SequenceMember& member, int type, const std::string& field);

// Matches the particles of all types. Throws DataError when the two have none in common or no
// ids, UsageError when there are no velocities for hermite.
std::shared_ptr<const SnapshotPair> make_pair(std::shared_ptr<const SequenceMember> first,
                                              std::shared_ptr<const SequenceMember> second,
                                              const SequenceSettings& settings);

// For snapshots without a particle in common.
[[noreturn]] void refuse_strangers(const SnapshotInfo& first, const SnapshotInfo& second);

}  // namespace splotchcl
