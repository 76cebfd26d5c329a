#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace splotchcl {

// Particles [begin, end) of those that a pass goes over.
struct ParticleRun {
  std::size_t begin = 0, end = 0;
};

// Ranks that make passes over the same particles together.
class PassRanks {
 public:
  using Bytes = std::vector<std::byte>;

  PassRanks() = default;
  PassRanks(const PassRanks&) = delete;
  PassRanks& operator=(const PassRanks&) = delete;
  virtual ~PassRanks() = default;

  // Collective: every rank has what all ranks gave, by rank.
  virtual std::vector<Bytes> gather(const Bytes& own) const = 0;
  // Around a rank's looking at particles of its own, and at no others.
  virtual void begin_own() const {}
  virtual void end_own() const {}
};

// A pass over all particles of a column or a component: what follows from all of them is found
// through one. A process by itself looks at all. Of several ranks each looks at runs of its own,
// and afterwards all know what any of them has found, in the order of the particles: so what they
// make of it has the bits of one process.
class ParticlePass {
 public:
  // By this process alone.
  explicit ParticlePass(std::size_t count) : own_{{0, count}} {}
  // All ranks have as many runs. The first runs of all ranks follow each other, then the second
  // ones, and so on.
  ParticlePass(std::vector<ParticleRun> own, std::shared_ptr<const PassRanks> ranks)
      : own_(std::move(own)), ranks_(std::move(ranks)) {}

  // Collective. `look(run, found)` looks at one of this rank's runs and appends what it finds to
  // the vector `found`. Returns what all ranks have found.
  template <class T, class Look>
  std::vector<T> collect(const Look& look) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> found;
    std::vector<std::size_t> ends;  // bytes, of each run
    look_at_own([&](const ParticleRun& run) {
      look(run, found);
      ends.push_back(found.size() * sizeof(T));
    });
    if (!ranks_) return found;
    PassRanks::Bytes bytes(found.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), found.data(), bytes.size());
    bytes = in_order(std::move(bytes), ends);
    found.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(found.data(), bytes.data(), bytes.size());
    return found;
  }

 private:
  template <class Look>
  void look_at_own(const Look& look) const {
    const Own own(ranks_.get());
    for (const ParticleRun& run : own_)
      look(run);
  }

  // Ends where the work throws as well.
  class Own {
   public:
    explicit Own(const PassRanks* ranks) : ranks_(ranks) {
      if (ranks_ != nullptr) ranks_->begin_own();
    }
    Own(const Own&) = delete;
    Own& operator=(const Own&) = delete;
    ~Own() {
      if (ranks_ != nullptr) ranks_->end_own();
    }

   private:
    const PassRanks* ranks_;
  };

  PassRanks::Bytes in_order(PassRanks::Bytes own, const std::vector<std::size_t>& ends) const;

  std::vector<ParticleRun> own_;
  std::shared_ptr<const PassRanks> ranks_;  // null: this process alone
};

}  // namespace splotchcl
