#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/unfinished_file.h"
#include "splotchcl/error.h"

namespace splotchcl {

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

}  // namespace splotchcl
