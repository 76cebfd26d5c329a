#include "generate/large_universe.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/unfinished_file.h"
#include "generate/cell_lengths.h"
#include "generate/gadget_files.h"
#include "generate/gas.h"
#include "generate/universe_model.h"
#include "parallel/for_blocks.h"
#include "scene/hash.h"
#include "scene/morton_keys.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Records that are added in any order of their buckets and read bucket by bucket: on disk, in a
// file that is removed at the end.
template <class Record>
class SpilledRecords {
 public:
  // The file lies beside what it is made for.
  SpilledRecords(const std::filesystem::path& path, std::size_t buckets)
      : path_(path), file_(path), buckets_(buckets) {}

  void add(std::size_t bucket, const Record& record) {
    Bucket& to = buckets_[bucket];
    to.unwritten.push_back(record);
    if (to.unwritten.size() == records_of_chunk) write(to);
  }

  // In the order in which they were added. Afterwards, from any thread, but each bucket once.
  std::vector<Record> take(std::size_t bucket) {
    Bucket& from = buckets_[bucket];
    std::vector<Record> records(from.chunks.size() * records_of_chunk);
    std::ifstream file(file_.temporary_path(), std::ios::binary);
    for (std::size_t c = 0; c < from.chunks.size(); ++c) {
      file.seekg(static_cast<std::streamoff>(from.chunks[c] * bytes_of_chunk));
      file.read(reinterpret_cast<char*>(&records[c * records_of_chunk]), bytes_of_chunk);
    }
    if (!file) {
      throw DataError(path_.string() +
                      ": what was kept there meanwhile cannot be read again; check the disk");
    }
    records.insert(records.end(), from.unwritten.begin(), from.unwritten.end());
    from = {};
    return records;
  }

 private:
  static constexpr std::size_t records_of_chunk = 8192;
  static constexpr std::size_t bytes_of_chunk = records_of_chunk * sizeof(Record);

  struct Bucket {
    std::vector<std::uint64_t> chunks;  // their places in the file
    std::vector<Record> unwritten;
  };

  void write(Bucket& bucket) {
    file_.write(bucket.unwritten.data(), bytes_of_chunk);
    bucket.chunks.push_back(written_++);
    bucket.unwritten.clear();
  }

  std::filesystem::path path_;
  UnfinishedFile file_;
  std::vector<Bucket> buckets_;
  std::uint64_t written_ = 0;  // chunks
};

constexpr int cell_level = 5;  // of the cells that gas is born in, and that files have
constexpr std::size_t cells = std::size_t{1} << (3 * cell_level);
constexpr int cells_along = 1 << cell_level;
constexpr std::size_t blocks_at_once = 64;
constexpr std::uint64_t stars_of_block = 4096;
constexpr std::uint64_t most_files = 60;                // names that are removed at a signal
constexpr std::uint64_t most_in_files = 4'000'000'000;  // ids have 32 bits
constexpr std::uint64_t most_at_once = 16'000'000;      // particles that are sorted
constexpr std::uint64_t sampled = 1'000'000;            // that tell how full cells are

struct MadeParticle {
  std::array<float, 3> place{}, speed{};
  float value = 0;  // heat of gas, age of a star
};
using MadeParticles = std::vector<MadeParticle>;
using CellCounts = std::vector<std::uint64_t>;

std::uint64_t key_of(const MadeParticle& particle) {
  std::array<double, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    place[axis] = static_cast<double>(particle.place[axis]) / universe_box;
  return morton_key(place);
}
std::size_t cell_of(const MadeParticle& particle) {
  return cell_at(key_of(particle), cell_level);
}

MadeParticle made_particle(const Vec3& place, const Vec3& speed, double value) {
  MadeParticle made;
  const Vec3 inside = into_box(place);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    made.place[axis] = static_cast<float>(inside.a[axis]);
    made.speed[axis] = static_cast<float>(speed.a[axis]);
  }
  made.value = static_cast<float>(value);
  return made;
}

// Blocks of particles that are made alone, each from random numbers of its own.
class BlockMaker {
 public:
  BlockMaker(const GenerateSettings& settings, const ParticleShares& shares,
             std::uint64_t most_tracers)
      : shares_(shares),
        random_(settings.seed),
        seed_(hash_of(settings.seed)),
        universe_(shares.gas, std::min(shares.gas, most_tracers), random_) {}

  std::size_t gas_blocks() const { return cells; }
  std::size_t star_blocks() const {
    return static_cast<std::size_t>((shares_.stars + stars_of_block - 1) / stars_of_block);
  }

  // What is born in one cell, or as many as there would be among `all` in all.
  MadeParticles gas(std::size_t block, std::uint64_t all) const {
    Random random = random_of(2 * block);
    const std::uint64_t count = all * (block + 1) / cells - all * block / cells;
    const Vec3 shift = {{random.uniform(), random.uniform(), random.uniform()}};
    const double spacing = 1 / std::cbrt(static_cast<double>(std::max<std::uint64_t>(count, 1)));
    MadeParticles made;
    for (std::uint64_t i = 0; i < count; ++i) {
      const Vec3 birthplace = place_in_cell(block, even_place(i, random, 0.5 * spacing) + shift);
      const Universe::Gas gas = universe_.gas(birthplace, universe_.moved(birthplace), random);
      made.push_back(made_particle(gas.place, gas.speed, gas.heat));
    }
    return made;
  }
  MadeParticles stars(std::size_t block) const {
    Random random = random_of(2 * block + 1);
    const std::uint64_t first = block * stars_of_block;
    MadeParticles made;
    for (std::uint64_t i = first; i < std::min(first + stars_of_block, shares_.stars); ++i) {
      const Universe::Star star = universe_.star(random);
      made.push_back(made_particle(star.place, star.speed, static_cast<double>(star.age)));
    }
    return made;
  }

 private:
  Random random_of(std::uint64_t block) const { return Random(hash_of(seed_ + block)); }

  static Vec3 place_in_cell(std::size_t cell, const Vec3& part) {
    Vec3 place = {{0, 0, 0}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<double>(cell % cells_along);
      place.a[axis] = (row + part.a[axis] - std::floor(part.a[axis])) / cells_along;
      cell /= cells_along;
    }
    return place;
  }

  ParticleShares shares_;
  Random random_;
  std::uint64_t seed_;
  Universe universe_;
};

// Calls take(particle) for all blocks in their order, which are made on all cores.
template <class Make, class Take>
void for_made(std::size_t blocks, const Make& make, const Take& take,
              const std::function<void(double)>& progress = {}) {
  for (std::size_t first = 0; first < blocks; first += blocks_at_once) {
    std::vector<MadeParticles> made(std::min(blocks_at_once, blocks - first));
    for_blocks(made.size(), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t b = from; b < to; ++b)
        made[b] = make(first + b);
    });
    for (const MadeParticles& block : made)
      std::for_each(block.begin(), block.end(), take);
    if (progress) progress(static_cast<double>(first + made.size()) / static_cast<double>(blocks));
  }
}

// Which file has each cell, so that all have about as many particles.
std::vector<std::size_t> files_of_cells(const CellCounts& counts, std::uint64_t files) {
  std::uint64_t all = 0, before = 0;
  for (const std::uint64_t count : counts)
    all += count;
  std::vector<std::size_t> file_of_cell;
  for (const std::uint64_t count : counts) {
    const std::uint64_t middle = before + count / 2;
    file_of_cell.push_back(
        static_cast<std::size_t>(middle * files / std::max<std::uint64_t>(all, 1)));
    before += count;
  }
  // None is left out, and the last is not beyond the end.
  std::size_t next = 0, last = file_of_cell.front();
  for (std::size_t& file : file_of_cell) {
    if (file != last) ++next;
    last = std::exchange(file, next);
  }
  return file_of_cell;
}

std::filesystem::path file_path(const std::filesystem::path& base, std::size_t number) {
  std::filesystem::path path = base;
  path += "." + std::to_string(number);
  return path;
}

void refuse_to_mix(const std::filesystem::path& base, const std::filesystem::path& other) {
  if (!std::filesystem::exists(other)) return;
  throw UsageError(other.string() + ": found such a file, expected none, since " + base.string() +
                   ".0 and on would be taken for parts of another snapshot; remove it, or choose "
                   "another name");
}

// Gas or stars, on the way to their files.
struct MadeType {
  MadeType(const std::filesystem::path& base, const char* name, std::size_t files)
      : records(std::filesystem::path(base) += name, files), counts(cells, 0) {}

  void add(const MadeParticle& particle, const std::vector<std::size_t>& file_of_cell) {
    const std::size_t cell = cell_of(particle);
    ++counts[cell];
    records.add(file_of_cell[cell], particle);
  }

  SpilledRecords<MadeParticle> records;
  CellCounts counts;
};

// Particles of a file with their smoothing lengths, in Morton order. Afterwards `made` has theirs.
GeneratedParticles in_order(MadeParticles& made, const CellLengths& cell_lengths) {
  std::vector<KeyedParticle> keyed(made.size());
  for (std::size_t i = 0; i < made.size(); ++i)
    keyed[i] = {key_of(made[i]), static_cast<std::uint32_t>(i)};
  sort_by_key(keyed);
  GeneratedParticles particles;
  particles.smoothing_length = cell_lengths.find(keyed);
  for (float& length : particles.smoothing_length)
    length *= static_cast<float>(universe_box);
  MadeParticles sorted(made.size());
  for (std::size_t i = 0; i < made.size(); ++i)
    sorted[i] = made[keyed[i].place];
  made.swap(sorted);
  particles.position.reserve(3 * made.size());
  particles.velocity.reserve(3 * made.size());
  for (const MadeParticle& particle : made) {
    particles.position.insert(particles.position.end(), particle.place.begin(),
                              particle.place.end());
    particles.velocity.insert(particles.velocity.end(), particle.speed.begin(),
                              particle.speed.end());
  }
  return particles;
}

class LargeUniverseWriter {
 public:
  LargeUniverseWriter(const std::filesystem::path& base, const GenerateSettings& settings,
                      const LargeUniverse& large, const UniverseProgress& progress)
      : base_(base),
        progress_(progress),
        shares_(share_particles(settings, most_in_files)),
        maker_(settings, shares_, large.most_tracers) {
    const std::uint64_t wanted =
        settings.particles / std::max<std::uint64_t>(large.particles_of_file, 1);
    file_of_cell_ =
        files_of_cells(sampled_counts(), std::clamp<std::uint64_t>(wanted, 1, most_files));
    files_ = file_of_cell_.back() + 1;
    refuse_to_mix(base_, file_path(base_, files_));
  }

  WrittenUniverse write() {
    MadeType gas(base_, ".gas", files_), stars(base_, ".stars", files_);
    for_made(
        maker_.gas_blocks(), [&](std::size_t block) { return maker_.gas(block, shares_.gas); },
        [&](const MadeParticle& made) { gas.add(made, file_of_cell_); }, stage("making gas"));
    for_made(
        maker_.star_blocks(), [&](std::size_t block) { return maker_.stars(block); },
        [&](const MadeParticle& made) { stars.add(made, file_of_cell_); }, stage("making stars"));
    return write_files(gas, stars);
  }

 private:
  std::function<void(double)> stage(const char* name) const {
    if (!progress_) return {};
    return [this, name](double fraction) { progress_(name, fraction); };
  }

  CellCounts sampled_counts() const {
    CellCounts counts(cells, 0);
    const auto count = [&](const MadeParticle& made) { ++counts[cell_of(made)]; };
    const std::uint64_t gas = std::min(sampled, shares_.gas);
    for_made(
        maker_.gas_blocks(), [&](std::size_t block) { return maker_.gas(block, gas); }, count);
    const double part = static_cast<double>(gas) / static_cast<double>(shares_.gas);
    const auto star_blocks =
        static_cast<std::size_t>(std::ceil(part * static_cast<double>(maker_.star_blocks())));
    for_made(
        star_blocks, [&](std::size_t block) { return maker_.stars(block); }, count);
    return counts;
  }

  WrittenUniverse write_files(MadeType& gas, MadeType& stars) {
    WrittenUniverse written = {shares_.gas, shares_.stars, {}};
    std::vector<std::unique_ptr<UnfinishedFile>> files;
    for (std::size_t f = 0; f < files_; ++f) {
      written.files.push_back(file_path(base_, f));
      files.push_back(std::make_unique<UnfinishedFile>(written.files.back()));
    }
    const CellLengths gas_lengths(gas.counts, cell_level), star_lengths(stars.counts, cell_level);
    const std::vector<GadgetSet> sets = sets_of(gas.counts, stars.counts);
    for_blocks_on(
        threads(), files_, 1,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t f = first; f < last; ++f) {
            MadeParticles gas_made = gas.records.take(f), stars_made = stars.records.take(f);
            GeneratedSnapshot part;
            part.box_size = universe_box;
            part.gas = in_order(gas_made, gas_lengths);
            part.stars = in_order(stars_made, star_lengths);
            complete(part, gas_made, stars_made);
            write_gadget2_part(*files[f], part, sets[f]);
          }
        },
        stage("writing"));
    for (const auto& file : files)
      file->finish();
    return written;
  }

  void complete(GeneratedSnapshot& part, const MadeParticles& gas,
                const MadeParticles& stars) const {
    const double mean = mean_gas_density();
    const double all = mean * universe_box * universe_box * universe_box;
    part.gas.mass = static_cast<float>(all / static_cast<double>(shares_.gas));
    if (shares_.stars > 0)
      part.stars.mass =
          static_cast<float>(stars_per_gas * all / static_cast<double>(shares_.stars));
    set_densities(part.gas);
    for (std::size_t i = 0; i < gas.size(); ++i) {
      const double energy = web_energy(static_cast<double>(part.gas.density[i]) / mean);
      part.gas.internal_energy.push_back(
          static_cast<float>(energy + static_cast<double>(gas[i].value)));
    }
    for (const MadeParticle& star : stars)
      part.stars.age.push_back(star.value);
  }

  std::vector<GadgetSet> sets_of(const CellCounts& gas, const CellCounts& stars) const {
    std::vector<GadgetSet> sets(
        files_, {shares_.gas, shares_.stars, static_cast<std::uint32_t>(files_), 0});
    std::uint32_t before = 1;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      std::uint32_t& first = sets[file_of_cell_[cell]].first_id;
      if (first == 0) first = before;
      before += static_cast<std::uint32_t>(gas[cell] + stars[cell]);
    }
    return sets;
  }

  std::size_t threads() const {
    const std::uint64_t of_file = (shares_.gas + shares_.stars) / files_ + 1;
    const std::uint64_t most = std::max<std::uint64_t>(1, most_at_once / of_file);
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(std::thread::hardware_concurrency(), 1, most));
  }

  const std::filesystem::path& base_;
  const UniverseProgress& progress_;
  ParticleShares shares_;
  BlockMaker maker_;
  std::vector<std::size_t> file_of_cell_;
  std::size_t files_ = 0;
};

}  // namespace

WrittenUniverse write_large_universe(const std::filesystem::path& base,
                                     const GenerateSettings& settings, const LargeUniverse& large,
                                     const UniverseProgress& progress) {
  refuse_to_mix(base, base);
  return LargeUniverseWriter(base, settings, large, progress).write();
}

}  // namespace splotchcl
