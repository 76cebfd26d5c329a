#include "map/fits_writer.h"

#include "splotchcl/error.h"

namespace splotchcl {

void FitsWriter::CloseFits::operator()(fitsfile* file) const {
  int ignored = 0;
  fits_close_file(file, &ignored);
}

FitsWriter::FitsWriter(const std::filesystem::path& path) : path_(path) {
  fitsfile* file = nullptr;
  fits_create_memfile(&file, &memory_.data, &memory_.size, FileMemory::block, std::realloc,
                      &status_);
  file_.reset(file);
  check();
}

void FitsWriter::add_image(const std::vector<long>& sides, std::vector<float> values) {
  std::vector<long> axes = sides;
  fits_create_img(file_.get(), FLOAT_IMG, static_cast<int>(axes.size()), axes.data(), &status_);
  fits_write_img(file_.get(), TFLOAT, 1, static_cast<LONGLONG>(values.size()), values.data(),
                 &status_);
  check();
}

void FitsWriter::add_table(const std::vector<FitsColumn>& columns) {
  std::vector<std::string> texts;  // names, formats and units, which the library takes as char*
  for (const FitsColumn& column : columns) {
    texts.push_back(column.name);
    texts.push_back(std::to_string(column.in_a_row) + "E");
    texts.push_back(column.unit);
  }
  std::vector<char*> names, formats, units;
  for (std::size_t i = 0; i < texts.size(); i += 3) {
    names.push_back(texts[i].data());
    formats.push_back(texts[i + 1].data());
    units.push_back(texts[i + 2].data());
  }
  const auto rows = static_cast<LONGLONG>(columns.front().values.size()) / columns.front().in_a_row;
  fits_create_tbl(file_.get(), BINARY_TBL, rows, static_cast<int>(columns.size()), names.data(),
                  formats.data(), units.data(), nullptr, &status_);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::vector<float> values = columns[i].values;
    fits_write_col(file_.get(), TFLOAT, static_cast<int>(i) + 1, 1, 1,
                   static_cast<LONGLONG>(values.size()), values.data(), &status_);
  }
  check();
}

void FitsWriter::add_text(const char* key, const std::string& text, const char* comment) {
  fits_update_key_longstr(file_.get(), key, text.c_str(), comment, &status_);
  check();
}

void FitsWriter::add_number(const char* key, double value, const char* comment) {
  fits_update_key(file_.get(), TDOUBLE, key, &value, comment, &status_);
  check();
}

void FitsWriter::add_count(const char* key, long value, const char* comment) {
  fits_update_key(file_.get(), TLONG, key, &value, comment, &status_);
  check();
}

void FitsWriter::add_history(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = ' ';
  }
  fits_write_history(file_.get(), text.c_str(), &status_);
  check();
}

void FitsWriter::announce_long_texts() {
  fits_write_key_longwarn(file_.get(), &status_);
  check();
}

std::vector<unsigned char> FitsWriter::bytes() {
  LONGLONG header = 0, data = 0, end = 0;
  fits_get_hduaddrll(file_.get(), &header, &data, &end, &status_);
  fits_close_file(file_.release(), &status_);
  check();
  const auto* const first = static_cast<const unsigned char*>(memory_.data);
  return {first, first + end};
}

void FitsWriter::check() const {
  if (status_ == 0) return;
  char reason[FLEN_STATUS];
  fits_get_errstatus(status_, reason);
  throw DataError(path_.string() + ": could not be made: " + reason);
}

}  // namespace splotchcl
