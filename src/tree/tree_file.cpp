#include "tree/tree_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

#include "common/mapped_file.h"
#include "common/unfinished_file.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The file, in the machine's own endianness: a FileHeader, a TypeHeader for each type, then of each
// type its sections, each from a multiple of 64 bytes on; last the checksums of chunks of all that
// comes before, and theirs.
constexpr FileMark mark_of(char version) {
  return {'s', 'p', 'l', 'o', 't', 'c', 'h', 'c', 'l', ' ', 't', ' ', version, '\n', 0, 0};
}
constexpr FileMark mark = mark_of('5');
// Of trees without nodes of the rest, a place for particles, a sample, and mean colors; they are
// made anew.
constexpr FileMark older_marks[] = {mark_of('1'), mark_of('2'), mark_of('3'), mark_of('4')};
constexpr std::uint64_t alignment = 64, chunk_bytes = 1U << 20,
                        most_checked_bytes = std::uint64_t{1} << 30;
constexpr std::size_t name_bytes = 64;

struct FileHeader {
  FileMark mark;
  std::uint64_t key, types, bytes;  // of all but the checksums
};
// What the file has of particles.
enum class Stored : std::uint64_t { nothing, without_weights, of_one_weight, with_weights };
struct TypeHeader {
  std::int64_t type;
  std::uint64_t count, bad, weight, fields, levels, order_count;
  Stored loose;   // nothing: their order alone
  Stored sample;  // with others; nothing: of few particles
  std::uint64_t has_colors, colors;
  std::uint64_t sample_stride, others;
  double weight_of_all;
  double origin[3], side;
  double sample_weight_of_all, sample_origin[3];
  std::uint64_t nodes[TreeOfType::levels_at_most];
  char names[most_fields][name_bytes];
  char other_names[ParticleSample::most_others][name_bytes];
};
static_assert(sizeof(FileHeader) == 40 && sizeof(TypeHeader) == 864);

std::uint64_t key_of(const SnapshotInfo& info) {
  WordHash hash = hash_of_files(info);
  for (const ParticleTypeInfo& type : info.types) {
    hash.add(static_cast<std::uint64_t>(type.type));
    hash.add(type.count);
    // Another place in the same file is another snapshot, and so are other columns.
    for (const FieldInfo& field : type.fields)
      hash.add(field.file_name);
  }
  return hash.value();
}

std::uint64_t padded(std::uint64_t bytes) {
  return ceil_divide(bytes, alignment) * alignment;
}

// Bytes of a level's arrays, in the order in which they are stored.
std::array<std::uint64_t, 7> section_bytes(std::uint64_t nodes, std::uint64_t fields,
                                           bool has_colors) {
  const std::uint64_t groups = ceil_divide(nodes, TreeLevel::group);
  return {nodes * sizeof(TreeNode),
          nodes * fields * sizeof(SampledField),
          has_colors ? nodes * sizeof(MeanColor) : 0,
          nodes,
          nodes,
          groups * sizeof(std::uint64_t),
          groups * sizeof(std::uint64_t)};
}

// Columns of so many particles.
std::vector<std::uint64_t> stored_bytes(Stored stored, std::uint64_t count, std::uint64_t fields) {
  if (stored == Stored::nothing) return {};
  const std::uint64_t column = count * sizeof(float);
  std::vector<std::uint64_t> sections = {3 * column, column};
  if (stored == Stored::with_weights) sections.push_back(column);
  sections.insert(sections.end(), fields, column);
  return sections;
}

std::uint64_t sampled_count(const TypeHeader& header) {
  return header.sample == Stored::nothing ? 0 : ceil_divide(header.count, header.sample_stride);
}

// The order, or the columns of particles in it, and those of the sample.
std::vector<std::uint64_t> particle_bytes(const TypeHeader& header) {
  std::vector<std::uint64_t> sections =
      stored_bytes(header.loose, header.order_count, header.fields);
  if (sections.empty()) sections.push_back(header.order_count * sizeof(std::uint32_t));
  const auto of_sample =
      stored_bytes(header.sample, sampled_count(header), header.fields + header.others);
  sections.insert(sections.end(), of_sample.begin(), of_sample.end());
  return sections;
}

Stored stored_with(const Column& weights) {
  if (weights.is_absent()) return Stored::without_weights;
  return weights.is_uniform() ? Stored::of_one_weight : Stored::with_weights;
}

void copy_name(const std::string& name, char* to) {
  name.copy(to, name_bytes - 1);
}

void take_sample(const ParticleSample& sample, TypeHeader& header) {
  const Column& weights = sample.particles.weight;
  header.sample = stored_with(weights);
  header.sample_weight_of_all = static_cast<double>(weights.uniform_value());
  header.sample_stride = sample.stride;
  std::copy(sample.origin.a, sample.origin.a + 3, header.sample_origin);
  header.others = sample.others.size();
  for (std::size_t f = 0; f < sample.others.size(); ++f)
    copy_name(sample.other_names[f], header.other_names[f]);
}

TypeHeader header_of(const TreeOfType& tree, const TreeSource* particles) {
  TypeHeader header{};
  header.type = tree.type;
  header.count = tree.count;
  header.bad = tree.bad;
  header.weight = static_cast<std::uint64_t>(tree.weight);
  header.fields = tree.fields.size();
  header.levels = tree.levels.size();
  header.order_count = tree.order_count;
  if (particles != nullptr) {
    header.loose = stored_with(particles->weights);
    header.weight_of_all = static_cast<double>(particles->weights.uniform_value());
  }
  if (tree.sample) take_sample(*tree.sample, header);
  header.has_colors = tree.colors ? 1 : 0;
  header.colors = tree.colors.value_or(0);
  for (std::size_t axis = 0; axis < 3; ++axis)
    header.origin[axis] = tree.origin.a[axis];
  header.side = tree.side;
  for (std::size_t l = 0; l < tree.levels.size(); ++l)
    header.nodes[l] = tree.levels[l].count;
  for (std::size_t f = 0; f < tree.fields.size(); ++f)
    copy_name(tree.fields[f], header.names[f]);
  return header;
}

// Writes a file and the checksums of its chunks.
class CheckedWriter {
 public:
  explicit CheckedWriter(UnfinishedFile& file) : file_(file) {}

  void write(const void* data, std::uint64_t bytes) {
    const auto* from = static_cast<const std::byte*>(data);
    while (bytes > 0) {
      const std::uint64_t part = std::min(bytes, chunk_bytes - chunk_.size());
      chunk_.insert(chunk_.end(), from, from + part);
      from += part;
      bytes -= part;
      written_ += part;
      if (chunk_.size() == chunk_bytes) end_chunk();
    }
  }
  void pad() {
    const std::array<std::byte, alignment> zeros{};
    write(zeros.data(), padded(written_) - written_);
  }
  void finish() {
    if (!chunk_.empty()) end_chunk();
    file_.write(sums_.data(), sums_.size() * sizeof(std::uint64_t));
    const std::uint64_t sum = checksum(reinterpret_cast<const std::byte*>(sums_.data()),
                                       sums_.size() * sizeof(std::uint64_t));
    file_.write(&sum, sizeof sum);
  }

 private:
  void end_chunk() {
    sums_.push_back(checksum(chunk_.data(), chunk_.size()));
    file_.write(chunk_.data(), chunk_.size());
    chunk_.clear();
  }

  UnfinishedFile& file_;
  std::vector<std::byte> chunk_;
  std::vector<std::uint64_t> sums_;
  std::uint64_t written_ = 0;
};

std::uint64_t file_bytes(const std::vector<TypeHeader>& headers) {
  std::uint64_t bytes = padded(sizeof(FileHeader) + headers.size() * sizeof(TypeHeader));
  for (const TypeHeader& header : headers) {
    for (std::size_t l = 0; l < header.levels; ++l) {
      for (const std::uint64_t section :
           section_bytes(header.nodes[l], header.fields, header.has_colors != 0))
        bytes += padded(section);
    }
    for (const std::uint64_t section : particle_bytes(header))
      bytes += padded(section);
  }
  return bytes;
}

void write_values(const Column& values, std::size_t count, CheckedWriter& writer) {
  if (values.is_array()) {
    writer.write(values.data(), count * sizeof(float));
  } else {
    const std::vector<float> same(count, values[0]);
    writer.write(same.data(), count * sizeof(float));
  }
}

// Values of the tree's loose particles, in its order.
void write_column(const Column& column, std::size_t width, const TreeOfType& tree,
                  CheckedWriter& writer) {
  constexpr std::uint64_t at_once = std::uint64_t{1} << 22;
  for (std::uint64_t first = 0; first < tree.order_count; first += at_once) {
    const std::uint64_t last = std::min(tree.order_count, first + at_once);
    const Places places(tree.order + first, tree.order + last);
    write_values(picked_column(column, width, places, run_on_all_cores), width * places.size(),
                 writer);
  }
  writer.pad();
}

void write_particles(const TreeSource& source, const TreeOfType& tree, CheckedWriter& writer) {
  write_column(source.position, 3, tree, writer);
  write_column(source.smoothing_length, 1, tree, writer);
  if (stored_with(source.weights) == Stored::with_weights)
    write_column(source.weights, 1, tree, writer);
  for (const TreeSource::Field& field : source.fields)
    write_column(field.values, 1, tree, writer);
}

void write_sample(const ParticleSample& sample, CheckedWriter& writer) {
  const StoredParticles& particles = sample.particles;
  const std::size_t count = particles.smoothing_length.size();
  const auto write = [&](const Column& column, std::size_t width) {
    write_values(column, width * count, writer);
    writer.pad();
  };
  write(particles.position, 3);
  write(particles.smoothing_length, 1);
  if (stored_with(particles.weight) == Stored::with_weights) write(particles.weight, 1);
  for (const std::vector<Column>* const columns : {&particles.fields, &sample.others}) {
    for (const Column& column : *columns)
      write(column, 1);
  }
}

void write_sections(const TreeOfType& tree, const TreeSource* particles, CheckedWriter& writer) {
  for (const TreeLevel& level : tree.levels) {
    const void* const sections[] = {level.nodes,      level.fields, level.colors,
                                    level.children,   level.loose,  level.first_children,
                                    level.first_loose};
    const auto bytes = section_bytes(level.count, tree.fields.size(), tree.colors.has_value());
    for (std::size_t s = 0; s < bytes.size(); ++s) {
      writer.write(sections[s], bytes[s]);
      writer.pad();
    }
  }
  if (particles != nullptr) {
    write_particles(*particles, tree, writer);
  } else {
    writer.write(tree.order, tree.order_count * sizeof(std::uint32_t));
    writer.pad();
  }
  if (tree.sample) write_sample(*tree.sample, writer);
}

// The chunks' sums lie behind what they are of.
bool is_undamaged(const MappedFile& file, std::uint64_t bytes) {
  const std::uint64_t chunks = ceil_divide(bytes, chunk_bytes);
  const std::byte* const sums = file.data() + bytes;
  std::uint64_t last = 0;
  std::memcpy(&last, sums + chunks * sizeof(std::uint64_t), sizeof last);
  if (last != checksum(sums, static_cast<std::size_t>(chunks * sizeof(std::uint64_t))))
    return false;
  const std::uint64_t checked = file.size() <= most_checked_bytes ? chunks : 1;
  std::atomic<bool> is_good{true};
  for_blocks(static_cast<std::size_t>(checked), 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t c = first; c < end; ++c) {
      std::uint64_t expected = 0;
      std::memcpy(&expected, sums + c * sizeof expected, sizeof expected);
      const std::uint64_t begin = c * chunk_bytes;
      const auto size = static_cast<std::size_t>(std::min(chunk_bytes, bytes - begin));
      if (checksum(file.data() + begin, size) != expected) is_good = false;
    }
  });
  return is_good;
}

bool is_possible(const TypeHeader& header) {
  return header.fields <= most_fields && header.levels <= TreeOfType::levels_at_most &&
         header.weight <= 2 && header.has_colors <= 1 && header.loose <= Stored::with_weights &&
         header.sample <= Stored::with_weights &&
         (header.sample == Stored::nothing || header.sample_stride > 0) &&
         header.others <= ParticleSample::most_others && header.count >= header.bad &&
         header.order_count <= header.count &&
         std::all_of(std::begin(header.nodes), std::end(header.nodes),
                     [&](std::uint64_t nodes) { return nodes <= header.count; });
}

// Takes the sections of a mapped file in their order.
class Sections {
 public:
  Sections(std::shared_ptr<const MappedFile> file, std::uint64_t begin)
      : file_(std::move(file)), next_(begin) {}

  template <class T>
  void take(std::uint64_t bytes, const T*& array) {
    array = reinterpret_cast<const T*>(file_->data() + next_);
    next_ += padded(bytes);
  }
  const std::shared_ptr<const MappedFile>& file() const { return file_; }

 private:
  std::shared_ptr<const MappedFile> file_;
  std::uint64_t next_;
};

Column column_of(std::uint64_t values, Sections& sections) {
  const float* first = nullptr;
  sections.take(values * sizeof(float), first);
  return Column(sections.file(), first, static_cast<std::size_t>(values));
}

StoredParticles particles_of(const TypeHeader& header, Stored stored, double weight_of_all,
                             std::uint64_t count, Sections& sections) {
  StoredParticles particles;
  particles.position = column_of(3 * count, sections);
  particles.smoothing_length = column_of(count, sections);
  if (stored == Stored::with_weights) particles.weight = column_of(count, sections);
  if (stored == Stored::of_one_weight)
    particles.weight = Column::uniform(static_cast<float>(weight_of_all));
  for (std::size_t f = 0; f < header.fields; ++f)
    particles.fields.push_back(column_of(count, sections));
  return particles;
}

std::string name_at(const char* bytes) {
  return {bytes, strnlen(bytes, name_bytes)};
}

ParticleSample sample_of(const TypeHeader& header, Sections& sections) {
  ParticleSample sample;
  sample.stride = header.sample_stride;
  std::copy(header.sample_origin, header.sample_origin + 3, sample.origin.a);
  const std::uint64_t count = sampled_count(header);
  sample.particles =
      particles_of(header, header.sample, header.sample_weight_of_all, count, sections);
  for (std::size_t f = 0; f < header.others; ++f) {
    sample.other_names.push_back(name_at(header.other_names[f]));
    sample.others.push_back(column_of(count, sections));
  }
  return sample;
}

std::shared_ptr<const TreeOfType> tree_of(const TypeHeader& header, Sections& sections) {
  auto tree = std::make_shared<TreeOfType>();
  tree->type = static_cast<int>(header.type);
  tree->count = header.count;
  tree->bad = header.bad;
  tree->weight = static_cast<WeightModel>(header.weight);
  if (header.has_colors != 0) tree->colors = header.colors;
  for (std::size_t axis = 0; axis < 3; ++axis)
    tree->origin.a[axis] = header.origin[axis];
  tree->side = header.side;
  for (std::size_t f = 0; f < header.fields; ++f)
    tree->fields.push_back(name_at(header.names[f]));
  for (std::size_t l = 0; l < header.levels; ++l) {
    TreeLevel level;
    level.count = header.nodes[l];
    const auto bytes = section_bytes(level.count, header.fields, header.has_colors != 0);
    sections.take(bytes[0], level.nodes);
    sections.take(bytes[1], level.fields);
    sections.take(bytes[2], level.colors);
    sections.take(bytes[3], level.children);
    sections.take(bytes[4], level.loose);
    sections.take(bytes[5], level.first_children);
    sections.take(bytes[6], level.first_loose);
    tree->levels.push_back(level);
  }
  if (header.loose == Stored::nothing) {
    sections.take(header.order_count * sizeof(std::uint32_t), tree->order);
  } else {
    tree->particles =
        particles_of(header, header.loose, header.weight_of_all, header.order_count, sections);
  }
  if (header.sample != Stored::nothing) tree->sample = sample_of(header, sections);
  tree->order_count = header.order_count;
  tree->owner = sections.file();
  return tree;
}

bool is_regular(const std::filesystem::path& path) {
  std::error_code missing;
  return std::filesystem::is_regular_file(path, missing);
}

}  // namespace

std::filesystem::path tree_path(const SnapshotInfo& info) {
  std::filesystem::path path = info.files.front();
  path += ".splotchcl_tree";
  return path;
}

bool tree_is_of_use(const SnapshotInfo& info) {
  return info.has_positions_of_files && info.is_whole() && !info.files.empty() &&
         is_regular(info.files.front());
}

bool tree_is_there(const SnapshotInfo& info) {
  return tree_is_of_use(info) && is_regular(tree_path(info));
}

void write_trees(const SnapshotInfo& info, const std::vector<TreeOfType>& trees,
                 const std::vector<TreeSource>& particles) {
  const std::filesystem::path path = tree_path(info);
  const auto is_another = [&path](const FileMark& known) { return is_another_file(path, known); };
  if (is_another(mark) && std::all_of(std::begin(older_marks), std::end(older_marks), is_another)) {
    throw UsageError(fmt::format(
        "{}: found a file that is no tree, expected none or a tree; move it", path.string()));
  }
  if (!has_files_as_opened(info)) {
    throw DataError(info.files.front().string() +
                    ": was written anew while its tree was made; make it again when the snapshot "
                    "is complete");
  }
  const auto particles_of = [&particles](std::size_t t) {
    return particles.empty() ? nullptr : &particles.at(t);
  };
  std::vector<TypeHeader> headers;
  for (std::size_t t = 0; t < trees.size(); ++t)
    headers.push_back(header_of(trees[t], particles_of(t)));
  const FileHeader header = {mark, key_of(info), headers.size(), file_bytes(headers)};
  check_output_path(path);
  UnfinishedFile file(path);
  CheckedWriter writer(file);
  writer.write(&header, sizeof header);
  writer.write(headers.data(), headers.size() * sizeof(TypeHeader));
  writer.pad();
  for (std::size_t t = 0; t < trees.size(); ++t)
    write_sections(trees[t], particles_of(t), writer);
  writer.finish();
  file.finish();
}

std::optional<Trees> read_trees(const SnapshotInfo& info) {
  if (!tree_is_there(info) || !has_files_as_opened(info)) return std::nullopt;
  const auto file = MappedFile::open_if_possible(tree_path(info));
  FileHeader header{};
  if (file == nullptr || file->size() < sizeof header) return std::nullopt;
  std::memcpy(&header, file->data(), sizeof header);
  const std::uint64_t beginning = sizeof header + header.types * sizeof(TypeHeader);
  if (header.mark != mark || header.key != key_of(info) || header.types > info.types.size() ||
      file->size() < beginning)
    return std::nullopt;
  std::vector<TypeHeader> headers(static_cast<std::size_t>(header.types));
  std::memcpy(headers.data(), file->data() + sizeof header, headers.size() * sizeof(TypeHeader));
  if (!std::all_of(headers.begin(), headers.end(), is_possible) ||
      header.bytes != file_bytes(headers) ||
      file->size() != header.bytes + (ceil_divide(header.bytes, chunk_bytes) + 1) * 8 ||
      !is_undamaged(*file, header.bytes))
    return std::nullopt;
  Sections sections(file, padded(beginning));
  Trees trees;
  for (const TypeHeader& of_type : headers)
    trees.push_back(tree_of(of_type, sections));
  return trees;
}

}  // namespace splotchcl
