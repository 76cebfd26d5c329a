#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <utility>

#include "ranks/mpi_library.h"
#include "splotchcl/communicator.h"

namespace splotchcl {
namespace {

constexpr int tag = 1;

// MPI counts in int.
constexpr std::size_t most_at_once = std::size_t{1} << 30;

// Calls pass(first, count) for stretches that MPI can count.
template <class Pass>
void in_pieces(std::size_t bytes, const Pass& pass) {
  for (std::size_t first = 0; first < bytes; first += most_at_once)
    pass(first, static_cast<int>(std::min(most_at_once, bytes - first)));
}

// Waiting takes no core from those that the others are waiting for: MPI itself would ask again and
// again. What comes soon is not waited for long.
void finish(std::vector<MPI_Request>& requests) {
  using namespace std::chrono_literals;
  constexpr auto longest = 500us;
  auto pause = 1us;
  for (int done = 0;;) {
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
    if (done != 0) return;
    std::this_thread::sleep_for(pause);
    pause = std::min<std::chrono::microseconds>(2 * pause, longest);
  }
}

void finish(MPI_Request request) {
  std::vector<MPI_Request> requests = {request};
  finish(requests);
}

// Errors of MPI end all processes, with a line of its own.
class MpiRanks final : public Communicator {
 public:
  MpiRanks(MPI_Comm communicator, bool ends_mpi) : ends_mpi_(ends_mpi) {
    MPI_Comm_dup(communicator, &all_);
    MPI_Comm_set_errhandler(all_, MPI_ERRORS_ARE_FATAL);
    MPI_Comm_rank(all_, &rank_);
    MPI_Comm_size(all_, &size_);
    MPI_Comm on_host = MPI_COMM_NULL;
    MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &on_host);
    MPI_Comm_rank(on_host, &rank_on_host_);
    MPI_Comm_size(on_host, &size_on_host_);
    MPI_Comm_free(&on_host);
    std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
    int length = 0;
    MPI_Get_processor_name(name.data(), &length);
    host_.assign(name.data(), static_cast<std::size_t>(length));
  }
  ~MpiRanks() override {
    int is_finalized = 0;
    MPI_Finalized(&is_finalized);
    if (is_finalized != 0) return;
    MPI_Comm_free(&all_);
    if (ends_mpi_) MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int rank_on_host() const override { return rank_on_host_; }
  int size_on_host() const override { return size_on_host_; }
  std::string host() const override { return host_; }

  void broadcast(void* data, std::size_t bytes, int root) override {
    in_pieces(bytes, [&](std::size_t first, int count) {
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Ibcast(static_cast<char*>(data) + first, count, MPI_BYTE, root, all_, &request);
      finish(request);
    });
  }

  std::vector<Bytes> gather(const Bytes& own) override {
    std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size_));
    const std::uint64_t bytes = own.size();
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgather(&bytes, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, all_, &request);
    finish(request);
    const auto total = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
    return total <= most_at_once ? gather_at_once(own, sizes) : gather_one_by_one(own, sizes);
  }

  void add_up(std::vector<std::uint64_t>& values) override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_UINT64_T,
                   MPI_SUM, all_, &request);
    finish(request);
  }

  std::vector<Bytes> exchange(std::vector<Bytes> parts) override {
    const auto count = static_cast<std::size_t>(size_);
    std::vector<std::uint64_t> sent(count), received(count);
    std::transform(parts.begin(), parts.end(), sent.begin(),
                   [](const Bytes& part) { return part.size(); });
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ialltoall(sent.data(), 1, MPI_UINT64_T, received.data(), 1, MPI_UINT64_T, all_, &request);
    finish(request);
    // All memory before the first message: what is under way must not be freed.
    std::vector<Bytes> all(count);
    for (std::size_t from = 0; from < count; ++from)
      if (from != static_cast<std::size_t>(rank_))
        all[from].resize(static_cast<std::size_t>(received[from]));
    std::vector<MPI_Request> requests;
    for (int step = 1; step < size_; ++step) {
      const int from = (rank_ + size_ - step) % size_;
      Bytes& part = all[static_cast<std::size_t>(from)];
      in_pieces(part.size(), [&](std::size_t first, int bytes) {
        MPI_Irecv(part.data() + first, bytes, MPI_BYTE, from, tag, all_, &requests.emplace_back());
      });
    }
    for (int step = 1; step < size_; ++step) {
      const int to = (rank_ + step) % size_;
      const Bytes& part = parts[static_cast<std::size_t>(to)];
      in_pieces(part.size(), [&](std::size_t first, int bytes) {
        MPI_Isend(part.data() + first, bytes, MPI_BYTE, to, tag, all_, &requests.emplace_back());
      });
    }
    all[static_cast<std::size_t>(rank_)] = std::move(parts[static_cast<std::size_t>(rank_)]);
    finish(requests);
    return all;
  }

  void send(const void* data, std::size_t bytes, int to) override {
    in_pieces(bytes, [&](std::size_t first, int count) {
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Isend(static_cast<const char*>(data) + first, count, MPI_BYTE, to, tag, all_, &request);
      finish(request);
    });
  }
  void receive(void* data, std::size_t bytes, int from) override {
    in_pieces(bytes, [&](std::size_t first, int count) {
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Irecv(static_cast<char*>(data) + first, count, MPI_BYTE, from, tag, all_, &request);
      finish(request);
    });
  }

  [[noreturn]] void abort(int code) override {
    MPI_Abort(all_, code);
    std::abort();
  }

 private:
  std::vector<Bytes> gather_at_once(const Bytes& own, const std::vector<std::uint64_t>& sizes) {
    std::vector<int> counts, places;
    int total = 0;
    for (const std::uint64_t size : sizes) {
      counts.push_back(static_cast<int>(size));
      places.push_back(total);
      total += counts.back();
    }
    Bytes together(static_cast<std::size_t>(total));
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgatherv(own.data(), static_cast<int>(own.size()), MPI_BYTE, together.data(),
                    counts.data(), places.data(), MPI_BYTE, all_, &request);
    finish(request);
    std::vector<Bytes> all;
    auto next = together.begin();
    for (const int count : counts) {
      all.emplace_back(next, next + count);
      next += count;
    }
    return all;
  }

  std::vector<Bytes> gather_one_by_one(const Bytes& own, const std::vector<std::uint64_t>& sizes) {
    std::vector<Bytes> all(sizes.size());
    all[static_cast<std::size_t>(rank_)] = own;
    for (int rank = 0; rank < size_; ++rank) {
      Bytes& part = all[static_cast<std::size_t>(rank)];
      part.resize(static_cast<std::size_t>(sizes[static_cast<std::size_t>(rank)]));
      broadcast(part.data(), part.size(), rank);
    }
    return all;
  }

  MPI_Comm all_ = MPI_COMM_NULL;
  bool ends_mpi_;
  int rank_ = 0, size_ = 1, rank_on_host_ = 0, size_on_host_ = 1;
  std::string host_;
};

// Ranks of an MPI communicator. What they tell each other does not meet what the program around
// sends: they have a duplicate of it. Collective. `ends_mpi`: MPI is finalized when it goes.
std::unique_ptr<Communicator> mpi_ranks(MPI_Comm communicator, bool ends_mpi) {
  return std::make_unique<MpiRanks>(communicator, ends_mpi);
}

class Mpi final : public MpiLibrary {
 public:
  std::unique_ptr<Communicator> start() const override {
    int provided = 0;
    // Other threads write files and compile kernels; one of them calls MPI.
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    return mpi_ranks(MPI_COMM_WORLD, true);
  }
  std::unique_ptr<Communicator> ranks_of(const void* communicator) const override {
    int is_initialized = 0;
    MPI_Initialized(&is_initialized);
    if (is_initialized == 0) return nullptr;
    return mpi_ranks(*static_cast<const MPI_Comm*>(communicator), false);
  }
};

}  // namespace

}  // namespace splotchcl

extern "C" __attribute__((visibility("default"))) const splotchcl::MpiLibrary*
splotchcl_mpi_library() {
  static const splotchcl::Mpi library;
  return &library;
}
