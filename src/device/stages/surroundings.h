#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/opencl/buffer_pool.h"
#include "device/stages/clouds_in_lists.h"
#include "splotchcl/plan.h"
#include "surroundings/cloud_around.h"
#include "surroundings/smooth_picture.h"

namespace splotchcl {

// Clouds around the camera, which the projection leaves out and counts: worked out by the host, in
// double precision, since they are few and smooth. The stage `surroundings`.
class Surroundings {
 public:
  explicit Surroundings(const StageContext& context) : context_(context) {}

  // Of sums that turn out to have some: there they wait for nobody.
  void get_programs() const;

  // Those of the blocks' particles that the projection has left out, `counted` of them, in file
  // order; `get`: the particles of one chunk.
  std::vector<CloudAround> list(const std::vector<ChunkBlocks>& chunks,
                                const std::function<ParticleBuffers(const ParticleChunk&)>& get,
                                std::uint64_t counted) const;
  // All of a frame: nearest first, in file order where keys are equal, and no larger than shows.
  std::vector<CloudAround> in_order(std::vector<CloudAround> clouds) const;

  // Ends them nearer: of what they may err by, half is lost there. Not for what is interpolated.
  void end_nearer(std::vector<CloudAround>& clouds) const { end_where_nothing_shows(clouds, 0.5); }

  // The layer's clouds: behind what is in the planes of an ordered frame, or added to a sum.
  void draw(const std::vector<CloudAround>& clouds, const CloudLayer& layer,
            const Planes& planes) const;
  // The part of the promise that all of this may spend.
  static constexpr double share_of_promise = 0.02;

 private:
  double brightest() const;
  // All of them together lose no more than this part of what they may err by.
  void end_where_nothing_shows(std::vector<CloudAround>& clouds, double share) const;
  // Particles and the keys by which they are sorted (list_around.cl).
  struct Found {
    std::uint64_t particle, key;
  };
  std::vector<Found> list(const ChunkBlocks& chunk, const ParticleBuffers& particles,
                          std::uint64_t most) const;
  void append(std::uint32_t c, const std::vector<Found>& found,
              std::vector<CloudAround>& clouds) const;
  // Pixels may err by `allowed`, interpolated.
  SmoothPicture picture_of(const std::vector<CloudAround>& clouds, const CloudLayer& layer,
                           double allowed, double brightest) const;
  // `parts` of the picture share what they may err by.
  void put_behind(const std::vector<CloudAround>& clouds, const CloudLayer& layer,
                  std::size_t parts, const Planes& planes) const;

  const StageContext& context_;
};

}  // namespace splotchcl
