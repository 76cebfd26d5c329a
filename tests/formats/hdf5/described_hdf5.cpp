#include "formats/hdf5/described_hdf5.h"

namespace splotchcl::test {
namespace {

std::vector<double> values_in(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> values;
  for (std::string word; words >> word;)
    values.push_back(std::stod(word));  // "nan" too, which streams do not read
  return values;
}

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream words(text);
  for (std::string name; std::getline(words >> std::ws, name, ',');)
    names.push_back(name);
  return names;
}

// Cut off, if it stands at the end.
bool take_suffix(std::string& text, const std::string& suffix) {
  if (text.size() < suffix.size() ||
      text.compare(text.size() - suffix.size(), suffix.size(), suffix) != 0)
    return false;
  text.resize(text.size() - suffix.size());
  return true;
}

void make_group_once(const Hdf5Output& file, const std::string& name) {
  if (name != "/" && H5Lexists(file.id(), name.c_str(), H5P_DEFAULT) <= 0) make_group(file, name);
}

// Of no dimension.
void write_scalar(const Hdf5Output& file, const std::string& path, double value) {
  const Hdf5Handle<H5Sclose> space(H5Screate(H5S_SCALAR));
  const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), path.c_str(), H5T_IEEE_F64LE, space.id(),
                                                H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
}

// The type in the file, which is cut off the end of a name.
hid_t take_type(std::string& name) {
  const std::pair<const char*, hid_t> types[] = {{" f32", H5T_IEEE_F32LE}, {" i8", H5T_STD_I8LE},
                                                 {" i16", H5T_STD_I16LE},  {" i32", H5T_STD_I32LE},
                                                 {" u32", H5T_STD_U32LE},  {" u64", H5T_STD_U64LE}};
  for (const auto& [suffix, stored] : types)
    if (take_suffix(name, suffix)) return stored;
  return H5T_IEEE_F64LE;
}

void write_dataset(const Hdf5Output& file, std::string path, const std::string& values) {
  const hid_t type = take_type(path);
  hsize_t width = 1;
  if (const std::size_t times = path.rfind(" x"); times != std::string::npos) {
    width = std::stoul(path.substr(times + 2));
    path.resize(times);
  }
  write_values(file, path, values_in(values), width, type);
}

void write_part(const Hdf5Output& file, const std::string& part) {
  const std::size_t colon = part.find(": ");
  std::string name = part.substr(0, colon);
  const std::string value = colon == std::string::npos ? "" : part.substr(colon + 2);
  if (name.rfind("gadget ", 0) == 0) {
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", values_in(name.substr(7)));
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
  } else if (const std::size_t at = name.find('@'); at != std::string::npos) {
    const std::string object = name.substr(0, at);
    std::string attribute = name.substr(at + 1);
    if (attribute.back() == ':') attribute.pop_back();  // without values
    const hid_t type = take_type(attribute);
    make_group_once(file, object);
    if (value == "true" || value == "false") {
      write_truth(file, object, attribute, value == "true");
    } else if (!value.empty() && value.front() == '"') {
      write_text(file, object, attribute, value.substr(1));
    } else {
      write_attribute(file, object, attribute, values_in(value), type);
    }
  } else if (const std::size_t of = name.find(" of "); of != std::string::npos) {
    write_records(file, name.substr(0, of), names_in(name.substr(of + 4)), values_in(value));
  } else if (take_suffix(name, " scalar")) {
    write_scalar(file, name, std::stod(value));
  } else if (take_suffix(name, " lines")) {
    write_lines(file, name, names_in(value));
  } else if (colon == std::string::npos && name.back() != ':') {
    make_group_once(file, name);
  } else {
    if (name.back() == ':') name.pop_back();  // without rows
    write_dataset(file, name, value);
  }
}

}  // namespace

void write_described_hdf5(const std::filesystem::path& path, const std::string& description) {
  const Hdf5Output file = create_hdf5(path);
  std::istringstream lines(description);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string& part : parts_between_bars(line))
      write_part(file, part);
  }
}

TEST_P(DescribedHdf5, IsReadOrRefused) {
  const TemporaryFolder folder;
  for (const std::string& content : GetParam().contents) {
    SCOPED_TRACE(content);
    write_described_hdf5(folder / "snap.hdf5", content);
    expect_snapshot(folder / "snap.hdf5", GetParam().options, GetParam().expected);
  }
}

}  // namespace splotchcl::test
