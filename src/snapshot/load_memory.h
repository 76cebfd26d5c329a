#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace splotchcl {

class Communicator;
class Snapshot;

// What decide and load have made from one snapshot and will want again for the next frame of a
// film: derived fields, selections, snapshots of single components. What two loads of
// frames in a row did not ask for is forgotten.
class LoadMemory {
 public:
  // The value that `make` gave for this key, now or before.
  template <class T>
  const T& get(const std::string& key, const std::function<T()>& make) {
    return own_.get(key, make);
  }
  // In place of what `make` would give.
  template <class T>
  void set(const std::string& key, T value) {
    own_.set(key, std::move(value));
  }
  // The same for what does not depend on the snapshot: lists of ids, pictures behind all.
  template <class T>
  const T& get_for_all_times(const std::string& key, const std::function<T()>& make) {
    return shared_->values.get(key, make);
  }

  // The snapshot of a single component, opened once.
  using OpenCompanion = std::function<std::shared_ptr<const Snapshot>(const std::string& path)>;
  std::shared_ptr<const Snapshot> companion(const std::string& path, const OpenCompanion& open);
  // Takes the place of the file.
  void set_companion(const std::string& path, std::shared_ptr<const Snapshot> snapshot) {
    shared_->companions[path] = std::move(snapshot);
  }
  void share_with(const LoadMemory& other) { shared_ = other.shared_; }

  // Ranks that all have this snapshot, and look at its particles together (load/passes.h). Null:
  // this process looks at all.
  const std::shared_ptr<Communicator>& ranks() const { return shared_->ranks; }
  void set_ranks(std::shared_ptr<Communicator> ranks) { shared_->ranks = std::move(ranks); }

  // All that was made from this snapshot; what does not depend on it is kept.
  void forget_own() { own_ = {}; }

  void begin_load();

 private:
  class Values {
   public:
    template <class T>
    const T& get(const std::string& key, const std::function<T()>& make) {
      auto found = values_.find(key);
      if (found == values_.end()) {
        T made = make();  // may ask for others
        found = values_.insert_or_assign(key, Value{std::move(made), 0}).first;
      }
      found->second.last_load = load_;
      return std::any_cast<const T&>(found->second.value);
    }
    template <class T>
    void set(const std::string& key, T value) {
      values_.insert_or_assign(key, Value{std::move(value), load_});
    }
    void begin_load();

   private:
    struct Value {
      std::any value;
      std::uint64_t last_load;
    };
    std::map<std::string, Value> values_;
    std::uint64_t load_ = 0;
  };
  struct Shared {
    std::map<std::string, std::shared_ptr<const Snapshot>> companions;
    Values values;
    std::shared_ptr<Communicator> ranks;
  };

  Values own_;
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

}  // namespace splotchcl
