#include "device/ranks/cloud_packets.h"

#include <cstring>
#include <type_traits>

namespace splotchcl {
namespace {

// What each cloud has, before its splats.
struct FixedPart {
  std::uint64_t key = 0, splats = 0;
  Vec3 center{};
  double ray = 0, splat = 0;
  std::array<double, 3> emission{}, absorption{};
  double farthest2 = 0;
};
static_assert(std::is_trivially_copyable_v<FixedPart> && std::is_trivially_copyable_v<SplatAround>);

template <class T>
void append(const T& value, Communicator::Bytes& bytes) {
  const std::size_t first = bytes.size();
  bytes.resize(first + sizeof(T));
  std::memcpy(bytes.data() + first, &value, sizeof(T));
}

template <class T>
T take(const Communicator::Bytes& bytes, std::size_t& next) {
  T value;
  std::memcpy(&value, bytes.data() + next, sizeof(T));
  next += sizeof(T);
  return value;
}

}  // namespace

std::vector<CloudAround> gather_clouds(Communicator& ranks, const std::vector<CloudAround>& own) {
  Communicator::Bytes bytes;
  for (const CloudAround& cloud : own) {
    append(FixedPart{cloud.key, cloud.splats.size(), cloud.center, cloud.ray, cloud.splat,
                     cloud.emission, cloud.absorption, cloud.farthest2},
           bytes);
    for (const SplatAround& splat : cloud.splats)
      append(splat, bytes);
  }
  std::vector<CloudAround> clouds;
  for (const Communicator::Bytes& of_rank : ranks.gather(bytes)) {
    for (std::size_t next = 0; next < of_rank.size();) {
      const auto fixed = take<FixedPart>(of_rank, next);
      CloudAround& cloud = clouds.emplace_back();
      cloud.key = fixed.key;
      cloud.center = fixed.center;
      cloud.ray = fixed.ray;
      cloud.splat = fixed.splat;
      cloud.emission = fixed.emission;
      cloud.absorption = fixed.absorption;
      cloud.farthest2 = fixed.farthest2;
      for (std::uint64_t i = 0; i < fixed.splats; ++i)
        cloud.splats.push_back(take<SplatAround>(of_rank, next));
    }
  }
  return clouds;
}

}  // namespace splotchcl
