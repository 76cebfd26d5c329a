#include "ranks/spread_particles.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>

#include "ranks/exchange.h"
#include "scene/particle_columns.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Where values are asked for one after the other, more and more come at once.
constexpr std::size_t smallest_block = std::size_t{1} << 10;
constexpr std::size_t largest_block = std::size_t{1} << 18;

}  // namespace

SpreadColumn::SpreadColumn(std::shared_ptr<SpreadParticles> spread, std::uint64_t number,
                           Column own, std::vector<std::size_t> begins)
    : spread_(std::move(spread)),
      number_(number),
      own_(std::move(own)),
      begins_(std::move(begins)) {}

SpreadColumn::~SpreadColumn() {
  spread_->forget_column(number_);
}

SpreadColumn::Stretch SpreadColumn::of_rank(int rank, std::size_t begin, std::size_t end) const {
  const auto r = static_cast<std::size_t>(rank);
  return {std::max(begin, begins_[r]), std::min(end, begins_[r + 1])};
}

void SpreadColumn::copy_own(const Stretch& stretch, float* values) const {
  if (stretch.is_empty()) return;
  const std::size_t first = begins_[static_cast<std::size_t>(spread_->ranks().rank())];
  const ColumnStretch own(own_, stretch.begin - first, stretch.end - first);
  for (std::size_t i = stretch.begin; i < stretch.end; ++i)
    *values++ = own[i - first];
}

void SpreadColumn::make(std::size_t begin, std::size_t end, float* values) const {
  if (spread_->is_asking()) {
    spread_->ask(number_, begin, end);
    std::fill_n(values, end - begin, 0.0F);
  } else if (spread_->reads_from_others() && end - begin < smallest_block) {
    make_from_block(begin, end, values);
  } else {
    spread_->read(*this, begin, end, values);
  }
}

void SpreadColumn::make_from_block(std::size_t begin, std::size_t end, float* values) const {
  for (std::size_t i = begin; i < end; ++i) {
    if (i < block_begin_ || i >= block_begin_ + block_.size()) read_block(i);
    *values++ = block_[i - block_begin_];
  }
}

void SpreadColumn::read_block(std::size_t begin) const {
  const std::size_t before = block_.size();
  const bool goes_on =
      before > 0 && begin >= block_begin_ + before && begin < block_begin_ + 2 * before;
  const std::size_t length =
      goes_on ? std::clamp(2 * before, smallest_block, largest_block) : smallest_block;
  std::vector<float> block(std::min(length, size() - begin));
  spread_->read(*this, begin, begin + block.size(), block.data());
  block_ = std::move(block);
  block_begin_ = begin;
}

namespace {

// Of one rank to another.
struct Request {
  std::uint64_t column, begin, end;
};

// Overlapping stretches become one.
std::vector<SpreadColumn::Stretch> joined(std::vector<SpreadColumn::Stretch> stretches) {
  std::sort(stretches.begin(), stretches.end(),
            [](const auto& a, const auto& b) { return a.begin < b.begin; });
  std::vector<SpreadColumn::Stretch> all;
  for (const auto& stretch : stretches) {
    if (stretch.is_empty()) continue;
    if (!all.empty() && stretch.begin <= all.back().end) {
      all.back().end = std::max(all.back().end, stretch.end);
    } else {
      all.push_back(stretch);
    }
  }
  return all;
}

std::vector<Request> requests_in(const Communicator::Bytes& bytes) {
  std::vector<Request> requests(bytes.size() / sizeof(Request));
  if (!requests.empty()) std::memcpy(requests.data(), bytes.data(), bytes.size());
  return requests;
}

}  // namespace

SpreadParticles::SpreadParticles(std::shared_ptr<Communicator> ranks) : ranks_(std::move(ranks)) {}

Column SpreadParticles::spread(const Column& own, std::uint64_t own_particles,
                               std::size_t values_per_particle) {
  if (!own.is_array()) return own;
  std::vector<std::size_t> begins = {0};
  for (const std::uint64_t particles : gather(own_particles))
    begins.push_back(begins.back() + static_cast<std::size_t>(particles) * values_per_particle);
  auto column = std::make_shared<const SpreadColumn>(shared_from_this(), next_number_, own,
                                                     std::move(begins));
  columns_[next_number_++] = column.get();
  return Column::made_by(std::move(column));
}

std::vector<std::uint64_t> SpreadParticles::gather(std::uint64_t own) {
  wait_for_all(*ranks_);
  return gather_values(*ranks_, own);
}

void SpreadParticles::agree_on(const std::function<void()>& work) {
  try {
    agree(ranks_.get(), work);
  } catch (const AgreedFailure&) {
    // Ranks that were interrupted may have fewer columns.
    const std::vector<std::uint64_t> numbers = gather_values(*ranks_, next_number_);
    next_number_ = *std::max_element(numbers.begin(), numbers.end());
    throw;
  }
}

void SpreadParticles::ask(std::uint64_t column, std::size_t begin, std::size_t end) {
  wanted_[column].push_back({begin, end});
}

void SpreadParticles::read(const SpreadColumn& column, std::size_t begin, std::size_t end,
                           float* values) {
  if (mode_ == Mode::together) {
    wait_for_all(*ranks_);
    read_together(column, begin, end, values);
    return;
  }
  if (!read_here(column, begin, end, values)) {
    throw DataError("values " + std::to_string(begin) + " to " + std::to_string(end) +
                    " of a column that is spread over processes were wanted for drawing and had "
                    "not been fetched; please report it");
  }
}

void SpreadParticles::read_together(const SpreadColumn& column, std::size_t begin, std::size_t end,
                                    float* values) const {
  for (int rank = 0; rank < ranks_->size(); ++rank) {
    const Stretch stretch = column.of_rank(rank, begin, end);
    if (stretch.is_empty()) continue;
    float* const first = values + (stretch.begin - begin);
    if (rank == ranks_->rank()) column.copy_own(stretch, first);
    ranks_->broadcast(first, stretch.count() * sizeof(float), rank);
  }
}

const SpreadParticles::Fetched* SpreadParticles::find_fetched(std::uint64_t column,
                                                              std::size_t value) const {
  const auto of_column = fetched_.find(column);
  if (of_column == fetched_.end()) return nullptr;
  const auto behind = of_column->second.upper_bound(value);
  if (behind == of_column->second.begin()) return nullptr;
  const Fetched& fetched = std::prev(behind)->second;
  return value < fetched.end() ? &fetched : nullptr;
}

// From what this rank has or has fetched.
bool SpreadParticles::read_here(const SpreadColumn& column, std::size_t begin, std::size_t end,
                                float* values) const {
  for (std::size_t next = begin; next < end;) {
    const Stretch own = column.of_rank(ranks_->rank(), next, end);
    if (own.begin == next && !own.is_empty()) {
      column.copy_own(own, values + (next - begin));
      next = own.end;
      continue;
    }
    const Fetched* const fetched = find_fetched(column.number(), next);
    if (fetched == nullptr) return false;
    const std::size_t last = std::min(end, fetched->end());
    std::copy_n(fetched->values.data() + (next - fetched->begin), last - next,
                values + (next - begin));
    next = last;
  }
  return true;
}

void SpreadParticles::fetch(const std::function<void()>& ask) {
  forget();
  mode_ = Mode::asking;
  ask();
  mode_ = Mode::drawing;
  for (auto& [column, stretches] : wanted_)
    stretches = joined(std::move(stretches));
  std::vector<Communicator::Bytes> packets;
  for (int rank = 0; rank < ranks_->size(); ++rank)
    packets.push_back(request_to(rank));
  packets = ranks_->exchange(std::move(packets));
  for (Communicator::Bytes& packet : packets)
    packet = answer(packet);
  packets = ranks_->exchange(std::move(packets));
  for (int rank = 0; rank < ranks_->size(); ++rank)
    keep(rank, packets[static_cast<std::size_t>(rank)]);
  wanted_.clear();
}

// What is its own no rank asks for.
Communicator::Bytes SpreadParticles::request_to(int rank) const {
  std::vector<Request> requests;
  for (const auto& [number, stretches] : wanted_) {
    for (const Stretch& wanted : stretches) {
      const Stretch part = columns_.at(number)->of_rank(rank, wanted.begin, wanted.end);
      if (rank != ranks_->rank() && !part.is_empty())
        requests.push_back({number, part.begin, part.end});
    }
  }
  Communicator::Bytes bytes(requests.size() * sizeof(Request));
  if (!bytes.empty()) std::memcpy(bytes.data(), requests.data(), bytes.size());
  return bytes;
}

Communicator::Bytes SpreadParticles::answer(const Communicator::Bytes& request) const {
  std::vector<float> values;
  for (const Request& wanted : requests_in(request)) {
    const std::size_t first = values.size();
    values.resize(first + static_cast<std::size_t>(wanted.end - wanted.begin));
    columns_.at(wanted.column)->copy_own({wanted.begin, wanted.end}, values.data() + first);
  }
  Communicator::Bytes bytes(values.size() * sizeof(float));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

void SpreadParticles::keep(int from, const Communicator::Bytes& values) {
  const std::byte* next = values.data();
  for (const Request& asked : requests_in(request_to(from))) {
    const auto begin = static_cast<std::size_t>(asked.begin);
    Fetched fetched = {begin, std::vector<float>(static_cast<std::size_t>(asked.end) - begin)};
    std::memcpy(fetched.values.data(), next, fetched.values.size() * sizeof(float));
    next += fetched.values.size() * sizeof(float);
    fetched_[asked.column].emplace(begin, std::move(fetched));
  }
}

void SpreadParticles::forget() {
  wanted_.clear();
  fetched_.clear();
  mode_ = Mode::together;
}

std::vector<PassRanks::Bytes> RankPass::gather(const Bytes& own) const {
  Communicator& ranks = ranks_ ? *ranks_ : spread_->ranks();
  wait_for_all(ranks);
  std::vector<Bytes> all(static_cast<std::size_t>(ranks.size()));
  all[static_cast<std::size_t>(ranks.rank())] = own;
  // One after the other: a gathering is for little.
  for (int rank = 0; rank < ranks.size(); ++rank)
    broadcast_values(ranks, all[static_cast<std::size_t>(rank)], rank);
  return all;
}

void RankPass::begin_own() const {
  if (spread_) spread_->begin_own();
}

void RankPass::end_own() const {
  if (spread_) spread_->end_own();
}

ParticlePass shared_pass(const std::shared_ptr<Communicator>& ranks, std::size_t count) {
  if (!ranks) return ParticlePass(count);
  const auto border = [&](int rank) {
    return static_cast<std::size_t>(std::uint64_t{count} * static_cast<std::uint64_t>(rank) /
                                    static_cast<std::uint64_t>(ranks->size()));
  };
  const int rank = ranks->rank();
  return ParticlePass({{border(rank), border(rank + 1)}}, std::make_shared<const RankPass>(ranks));
}

}  // namespace splotchcl
