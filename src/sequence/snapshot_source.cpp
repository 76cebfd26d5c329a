#include "splotchcl/snapshot_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <future>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <unordered_set>

#include "formats/snapshot_format.h"
#include "parallel/ordered_tasks.h"
#include "sequence/interpolated_snapshot.h"
#include "sequence/snapshot_source.h"
#include "sequence/type_path.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/scene.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

// A pattern of names of groups in a file.
struct StepPattern {
  fs::path file;
  std::string group;  // that they are in; empty: the root
  std::string name;   // with the conversion
};

std::size_t first_conversion(const std::string& pattern) {
  std::size_t percent = pattern.find('%');
  while (percent != std::string::npos && percent + 1 < pattern.size() &&
         pattern[percent + 1] == '%')
    percent = pattern.find('%', percent + 2);
  return percent;
}

std::optional<StepPattern> step_pattern(const std::string& pattern) {
  const std::size_t percent = first_conversion(pattern);
  const std::size_t slash = pattern.rfind('/', percent);
  if (percent == std::string::npos || slash == std::string::npos) return std::nullopt;
  const fs::path before = fill_pattern(pattern.substr(0, slash), 0);
  const std::string name = pattern.substr(slash + 1, pattern.find('/', percent) - slash - 1);
  std::error_code ignored;
  if (fs::is_regular_file(before, ignored)) return StepPattern{before, "", name};
  const auto within = path_in_file(before);
  if (!within) return std::nullopt;
  return StepPattern{within->file, within->group, name};
}

// The number with which the pattern is the name.
std::optional<int> number_in(const std::string& name, const std::string& pattern) {
  for (std::size_t i = name.find_first_of("0123456789"); i != std::string::npos;
       i = name.find_first_of("0123456789", i + 1)) {
    int number = 0;
    const char* const end = name.data() + name.size();
    if (std::from_chars(name.data() + i, end, number).ec != std::errc()) continue;
    if (fill_pattern(pattern, number) == name) return number;
  }
  return std::nullopt;
}

std::vector<ListedSnapshot> list_steps(const StepPattern& steps, const SequenceSettings& settings) {
  const SnapshotFormat* const format = find_format(steps.file);
  std::set<int> numbers;
  if (format != nullptr) {
    for (const std::string& name : format->groups_in(steps.file, steps.group)) {
      const auto number = number_in(name, steps.name);
      if (number) numbers.insert(*number);
    }
  }
  std::vector<ListedSnapshot> list;
  const int first = settings.first.value_or(0);
  const int last = settings.last.value_or(std::numeric_limits<int>::max());
  for (const int number : numbers) {
    if (number < first || number > last) continue;
    list.push_back({static_cast<double>(number), fill_pattern(settings.pattern, number)});
  }
  if (!list.empty()) return list;
  throw UsageError(
      fmt::format("time.snapshots: found no group {} in {} with a number from {} to {}, expected "
                  "steps in time; "
                  "check the pattern, time.first and time.last",
                  steps.name, steps.file.string(), first, last));
}

}  // namespace

std::vector<ListedSnapshot> list_sequence(const SequenceSettings& settings) {
  const auto steps = settings.pattern.empty() ? std::nullopt : step_pattern(settings.pattern);
  return steps ? list_steps(*steps, settings) : list_snapshots(settings);
}

namespace {

using Member = std::shared_ptr<SequenceMember>;
using Pair = std::shared_ptr<const SnapshotPair>;

bool is_same_list(const SequenceSettings& a, const SequenceSettings& b) {
  return a.snapshots == b.snapshots && a.pattern == b.pattern && a.first == b.first &&
         a.last == b.last;
}

bool is_same_motion(const SequenceSettings& a, const SequenceSettings& b) {
  return a.interpolation == b.interpolation && a.omega_matter == b.omega_matter &&
         a.omega_lambda == b.omega_lambda && a.hubble_rate == b.hubble_rate;
}

Member open_member(const ListedSnapshot& listed, const SnapshotOptions& options) {
  return std::make_shared<SequenceMember>(open_snapshot(listed.path, options));
}

SnapshotOptions options_of(const Scene& scene) {
  return {scene.read.columns, scene.read.skip_lines, scene.read.units};
}

bool are_same(const SnapshotOptions& a, const SnapshotOptions& b) {
  return a.columns == b.columns && a.skip_lines == b.skip_lines && a.units == b.units;
}

// A snapshot that was read before it was needed, and its match with a neighbour.
struct Ahead {
  Member member;
  Pair pair;  // null: not interpolated
};

// Reads a mapped file's pages, so that no frame waits for them.
void touch(const Column& column) {
  constexpr std::size_t values_per_page = 1024;
  volatile float seen = 0;
  for (std::size_t i = 0; i < column.size(); i += values_per_page)
    seen = column[i];
  static_cast<void>(seen);
}

// What the last frame needed of a snapshot the next one will need of its neighbour.
void read_fields(const SequenceMember& member, const std::set<TypeField>& fields) {
  for (const auto& [type, field] : fields) {
    const ParticleTypeInfo* const info = member.info().find_type(type);
    if (info == nullptr) continue;
    const bool has_field =
        std::any_of(info->fields.begin(), info->fields.end(),
                    [&name = field](const FieldInfo& f) { return f.name == name; });
    if (has_field) touch(member.read(type, field));
  }
}

// Whether any particle of the one is in the other, by type and id.
bool share_particles(const Snapshot& first, const Snapshot& second) {
  for (const ParticleTypeInfo& type : first.info().types) {
    if (second.info().find_type(type.type) == nullptr) continue;
    const auto ids = first.read_ids(type.type);
    const std::unordered_set<std::uint64_t> sample(
        ids.begin(),
        ids.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(ids.size(), 4096)));
    const auto others = second.read_ids(type.type);
    const bool has_one = std::any_of(others.begin(), others.end(),
                                     [&](std::uint64_t id) { return sample.count(id) > 0; });
    if (has_one) return true;
  }
  return false;
}

}  // namespace

struct SnapshotSource::State {
  std::shared_ptr<const Snapshot> at(const Scene& scene);
  void check(const Scene& scene);

 private:
  void use_options(const SnapshotOptions& options);
  void use_box(const std::optional<BoxSides>& box);
  std::shared_ptr<const Snapshot> at_moment(const SequenceSettings& settings);
  void use_settings(const SequenceSettings& settings);
  void forget_pairs();
  Member member(std::size_t i);
  Pair pair(std::size_t first);
  void keep_only(std::size_t first, std::size_t last);
  void read_ahead(const SequencePlace& place);
  void take_ahead(std::size_t needed_first, std::size_t needed_last);

  // A scene without a sequence.
  std::string path_;
  std::shared_ptr<const Snapshot> single_;

  SequenceSettings settings_;
  SnapshotOptions options_;
  std::optional<BoxSides> box_;
  std::vector<ListedSnapshot> list_;
  std::map<std::size_t, Member> members_;
  std::map<std::size_t, Pair> pairs_;  // by their first snapshot
  std::optional<double> last_index_;
  std::shared_ptr<const Snapshot> last_;
  // Declared last, so that its thread ends before what it uses.
  std::size_t ahead_index_ = 0;
  std::future<Ahead> ahead_;
};

std::shared_ptr<const Snapshot> SnapshotSource::State::at(const Scene& scene) {
  if (scene.time.is_set()) {
    use_options(options_of(scene));
    use_box(scene.periodic.box);
    return at_moment(scene.time);
  }
  if (!single_ || path_ != scene.snapshot) {
    single_ = open_snapshot_for(scene.snapshot, scene.read);
    path_ = scene.snapshot;
  }
  return single_;
}

// Snapshots that are read otherwise are others.
void SnapshotSource::State::use_options(const SnapshotOptions& options) {
  if (!are_same(options, options_)) list_.clear();
  options_ = options;
}

void SnapshotSource::State::use_box(const std::optional<BoxSides>& box) {
  if (box != box_) forget_pairs();
  box_ = box;
}

void SnapshotSource::State::forget_pairs() {
  ahead_ = {};  // waits for its end
  pairs_.clear();
  last_.reset();
  last_index_.reset();
}

void SnapshotSource::State::use_settings(const SequenceSettings& settings) {
  const bool has_new_list = list_.empty() || !is_same_list(settings, settings_);
  if (has_new_list || !is_same_motion(settings, settings_)) forget_pairs();
  if (has_new_list) {
    members_.clear();
    list_ = list_sequence(settings);
  }
  settings_ = settings;
}

std::shared_ptr<const Snapshot> SnapshotSource::State::at_moment(const SequenceSettings& settings) {
  use_settings(settings);
  settings_.index = settings.index.value_or(list_.front().index);
  if (last_ && last_index_ == settings_.index) return last_;
  SequencePlace place = find_place(list_, *settings_.index);
  if (settings.interpolation == Interpolation::none) place.fraction = 0;
  const std::size_t last_needed = place.snapshot + (place.fraction > 0 ? 1 : 0);
  take_ahead(place.snapshot, last_needed);
  keep_only(place.snapshot, last_needed);
  std::shared_ptr<Snapshot> moment;
  if (place.fraction > 0) {
    moment = std::make_shared<InterpolatedSnapshot>(pair(place.snapshot), place.fraction);
  } else {
    moment = member(place.snapshot);
  }
  // Snapshots of single components are not opened anew for each frame.
  if (last_ && last_ != moment) moment->share_lasting_memory_of(*last_);
  last_ = std::move(moment);
  read_ahead(place);
  last_index_ = settings_.index;
  return last_;
}

Member SnapshotSource::State::member(std::size_t i) {
  Member& member = members_[i];
  if (!member) member = open_member(list_[i], options_);
  return member;
}

Pair SnapshotSource::State::pair(std::size_t first) {
  Pair& pair = pairs_[first];
  if (!pair) pair = make_pair(member(first), member(first + 1), settings_, box_);
  return pair;
}

void SnapshotSource::State::keep_only(std::size_t first, std::size_t last) {
  const auto forget = [](auto& map, auto&& is_needed) {
    for (auto it = map.begin(); it != map.end();)
      it = is_needed(it->first) ? std::next(it) : map.erase(it);
  };
  forget(members_, [&](std::size_t i) { return i >= first && i <= last; });
  forget(pairs_, [&](std::size_t i) { return i >= first && i + 1 <= last; });
}

// What the thread has read, when it is wanted now.
void SnapshotSource::State::take_ahead(std::size_t needed_first, std::size_t needed_last) {
  const bool is_needed = ahead_index_ >= needed_first && ahead_index_ <= needed_last;
  if (!ahead_.valid() || !is_needed) return;
  Ahead ahead = ahead_.get();
  members_[ahead_index_] = ahead.member;
  if (!ahead.pair) return;
  for (const std::size_t first : {ahead_index_, ahead_index_ - 1}) {
    const bool begins =
        first < list_.size() && members_.count(first) > 0 && members_[first] == ahead.pair->first;
    if (begins) pairs_[first] = ahead.pair;
  }
}

// Not on the first frame: it may be the only one.
void SnapshotSource::State::read_ahead(const SequencePlace& place) {
  const bool is_film = last_index_ && last_index_ != settings_.index;
  if (!is_film || !can_read_concurrently()) return;
  const bool is_forward = settings_.index > last_index_;
  const std::size_t edge = is_forward && place.fraction > 0 ? place.snapshot + 1 : place.snapshot;
  if (is_forward ? edge + 1 >= list_.size() : edge == 0) return;
  const std::size_t next = is_forward ? edge + 1 : edge - 1;
  if (members_.count(next) > 0 || (ahead_.valid() && ahead_index_ == next)) return;

  ahead_ = {};  // of another direction: waits for its end
  ahead_index_ = next;
  ahead_ = in_background([listed = list_[next], neighbor = member(edge), is_forward,
                          settings = settings_, options = options_, box = box_] {
    Ahead ahead;
    ahead.member = open_member(listed, options);
    read_fields(*ahead.member, neighbor->fields_read());
    if (settings.interpolation != Interpolation::none) {
      ahead.pair = is_forward ? make_pair(neighbor, ahead.member, settings, box)
                              : make_pair(ahead.member, neighbor, settings, box);
    }
    return ahead;
  });
}

void SnapshotSource::State::check(const Scene& scene) {
  const SequenceSettings& settings = scene.time;
  const SnapshotOptions options = options_of(scene);
  if (settings.interpolation == Interpolation::none) {
    for (const ListedSnapshot& listed : list_sequence(settings))
      open_snapshot(listed.path, options);
    return;
  }
  std::unique_ptr<Snapshot> before;
  for (const ListedSnapshot& listed : list_sequence(settings)) {
    std::unique_ptr<Snapshot> snapshot = open_snapshot(listed.path, options);
    if (before != nullptr) {
      if (settings.interpolation == Interpolation::hermite) {
        find_motion(before->info(), snapshot->info(), settings);
      }
      if (!share_particles(*before, *snapshot)) refuse_strangers(before->info(), snapshot->info());
    }
    before = std::move(snapshot);
  }
}

SnapshotSource::SnapshotSource() : state_(std::make_unique<State>()) {}
SnapshotSource::~SnapshotSource() = default;
SnapshotSource::SnapshotSource(SnapshotSource&&) noexcept = default;
SnapshotSource& SnapshotSource::operator=(SnapshotSource&&) noexcept = default;

std::shared_ptr<const Snapshot> SnapshotSource::at(const Scene& scene) {
  return state_->at(scene);
}

void SnapshotSource::check(const Scene& scene) {
  if (scene.time.is_set()) state_->check(scene);
}

}  // namespace splotchcl
