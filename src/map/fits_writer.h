#pragma once

#include <fitsio.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace splotchcl {

// A column of a table: one number a row.
struct FitsColumn {
  std::string name, unit;
  std::vector<float> values;
  int in_a_row = 1;  // several in one row, where that divides them
};

// A file in memory, so that what is written to the disk is ours to check.
class FitsWriter {
 public:
  // `path` is for messages.
  explicit FitsWriter(const std::filesystem::path& path);

  // The first axis changes fastest.
  void add_image(const std::vector<long>& sides, std::vector<float> values);
  void add_table(const std::vector<FitsColumn>& columns);
  void add_text(const char* key, const std::string& text, const char* comment);
  void add_number(const char* key, double value, const char* comment);
  void add_count(const char* key, long value, const char* comment);
  // Lines of a header hold printable ASCII only.
  void add_history(std::string text);
  void announce_long_texts();
  std::vector<unsigned char> bytes();

 private:
  // What a file in memory lies in, whose library makes it longer.
  struct FileMemory {
    static constexpr std::size_t block = 2880;

    FileMemory() = default;
    ~FileMemory() { std::free(data); }
    FileMemory(const FileMemory&) = delete;
    FileMemory& operator=(const FileMemory&) = delete;

    std::size_t size = block;
    void* data = std::malloc(block);
  };
  struct CloseFits {
    void operator()(fitsfile* file) const;
  };
  void check() const;

  std::filesystem::path path_;
  FileMemory memory_;  // outlives the file
  std::unique_ptr<fitsfile, CloseFits> file_;
  int status_ = 0;
};

}  // namespace splotchcl
