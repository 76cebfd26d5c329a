#include "formats/snapshot_rows.h"

#include <fmt/format.h>

#include "snapshot/field_names.h"
#include "text_rows.h"

namespace splotchcl::test {
namespace {

// Cut off the text. In single quotes it may hold blanks.
std::string first_word(std::string& text) {
  if (text.front() == '\'') {
    const std::size_t quote = text.find('\'', 1);
    const std::string quoted = text.substr(1, quote - 1);
    text.erase(0, quote + 2);
    return quoted;
  }
  const std::size_t end = text.find(' ');
  const std::string word = text.substr(0, end);
  text = end == std::string::npos ? "" : text.substr(end + 1);
  return word;
}

void expect_values(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i] == expected[i] || (std::isnan(found[i]) && std::isnan(expected[i])))
        << "value " << i << ": found " << found[i] << ", expected " << expected[i];
}

void expect_field(const Snapshot& snapshot, int type, const std::string& field,
                  const std::string& values) {
  if (field == "position") {
    expect_values(absolute_positions(snapshot, type), numbers_in<double>(values));
    return;
  }
  const Column column = snapshot.read(type, field);
  const std::vector<float> found = values_of(column);
  std::vector<double> expected = numbers_in<double>(values);
  for (double& value : expected)
    value = static_cast<double>(static_cast<float>(value));
  expect_values({found.begin(), found.end()}, expected);
}

std::string one_or_three(const BoxSides& sides) {
  std::ostringstream text;
  text << sides[0];
  if (sides[1] != sides[0] || sides[2] != sides[0]) text << ' ' << sides[1] << ' ' << sides[2];
  return text.str();
}

// What belongs to the snapshot as a whole; false for what does not.
bool expect_of_all(const Snapshot& snapshot, const std::string& what, const std::string& value) {
  const SnapshotInfo& info = snapshot.info();
  if (what == "format") {
    EXPECT_EQ(info.format, value);
  } else if (what == "note") {
    EXPECT_THAT(info.notes, Contains(HasSubstr(value)));
  } else if (what == "notes") {
    EXPECT_EQ(std::to_string(info.notes.size()), value);
  } else if (what == "no" && value == "notes") {
    EXPECT_THAT(info.notes, IsEmpty());
  } else if (what == "no" && value == "cosmology") {
    EXPECT_FALSE(info.cosmology);
  } else if (what == "no" && value == "redshift") {
    EXPECT_FALSE(info.redshift);
  } else if (what == "no" && value == "box") {
    EXPECT_FALSE(info.box_size);
  } else if (what == "box") {
    EXPECT_EQ(info.box_size ? one_or_three(*info.box_size) : "none", value);
  } else if (what == "time") {
    EXPECT_EQ(info.time, std::stod(value));
  } else if (what == "redshift") {
    EXPECT_EQ(info.redshift, std::stod(value));
  } else if (what == "hubble") {
    EXPECT_EQ(info.hubble_parameter, std::stod(value));
  } else if (what == "origin") {
    EXPECT_EQ(snapshot.position_origin().a[0], std::stod(value));
  } else if (what == "types") {
    EXPECT_EQ(std::to_string(info.types.size()), value);
  } else {
    return false;
  }
  return true;
}

void expect_of_type(const Snapshot& snapshot, std::string what, std::string value) {
  if (what == "no" && value.rfind("unit ", 0) == 0) {
    what = "unit";
    value.erase(0, 5);
  }
  std::string field = what == "unit" || what == "no" ? first_word(value) : what;
  const std::size_t slash = field.rfind('/');
  const bool names_type = slash != std::string::npos;
  const int type =
      names_type ? std::stoi(field.substr(slash + 1)) : snapshot.info().types.front().type;
  field = field.substr(0, slash);
  const ParticleTypeInfo* const particles = snapshot.info().find_type(type);
  ASSERT_NE(particles, nullptr);
  if (what == "unit") {
    EXPECT_EQ(require_field(snapshot.info(), type, field).unit, value);
  } else if (what == "no") {
    EXPECT_FALSE(has_field(snapshot, type, field));
  } else if (field == "count") {
    EXPECT_EQ(std::to_string(particles->count), value);
  } else if (field == "table_mass") {
    EXPECT_EQ(particles->table_mass, std::stod(value));
  } else if (field == "fields") {
    EXPECT_EQ(std::to_string(particles->fields.size()), value);
  } else if (field == "ids") {
    EXPECT_EQ(fmt::format("{}", fmt::join(snapshot.read_ids(type), " ")), value);
  } else if (field == "whole") {
    const std::string of = first_word(value);
    EXPECT_EQ(fmt::format("{}", fmt::join(snapshot.read_integers(type, of), " ")), value);
  } else {
    expect_field(snapshot, type, field, value);
  }
}

std::vector<std::string> words_between_commas(std::string text) {
  std::vector<std::string> words;
  for (std::size_t comma = 0; comma != std::string::npos;) {
    comma = text.find(", ");
    words.push_back(text.substr(0, comma));
    text.erase(0, comma == std::string::npos ? comma : comma + 2);
  }
  return words;
}

void add_option(SnapshotOptions& options, std::string value) {
  const std::string what = first_word(value);
  if (what == "columns") {
    options.columns = words_between_commas(value);
  } else if (what == "skip_lines") {
    options.skip_lines = std::stoi(value);
  } else {
    ASSERT_EQ(what, "units");
    options.units = words_between_commas(value);
  }
}

// Of opening it and of reading all of it.
template <class Refusal>
std::string refusal_of_all(const std::filesystem::path& path, const SnapshotOptions& options) {
  return refusal_by<Refusal>([&] {
    const auto snapshot = open_snapshot(path, options);
    for (const ParticleTypeInfo& type : snapshot->info().types) {
      for (const FieldInfo& field : type.fields)
        snapshot->read(type.type, field.name);
      if (has_field(*snapshot, type.type, "id")) snapshot->read_ids(type.type);
    }
  });
}

}  // namespace

std::vector<SnapshotRow> snapshot_rows(const std::string& file) {
  std::vector<SnapshotRow> rows;
  for (const TextRow& text : read_text_rows(source_folder() / "tests/formats" / file)) {
    SnapshotRow& row = rows.emplace_back(SnapshotRow{text.name, text.texts, "", {}});
    for (const std::string& part : text.expected) {
      if (part.rfind("with ", 0) == 0) {
        add_option(row.options, part.substr(5));
      } else {
        row.expected += (row.expected.empty() ? "" : " | ") + part;
      }
    }
  }
  return rows;
}

std::vector<std::string> parts_between_bars(const std::string& text) {
  const std::string bar = " | ";
  std::vector<std::string> parts;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + bar.size()) {
    end = text.find(bar, begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

void expect_snapshot(const std::filesystem::path& path, const SnapshotOptions& options,
                     const std::string& expected) {
  std::unique_ptr<Snapshot> snapshot;
  for (std::string value : parts_between_bars(expected)) {
    SCOPED_TRACE(value);
    const std::string what = first_word(value);
    if (what == "refused") {
      EXPECT_THAT(refusal_by<DataError>([&] { open_snapshot(path, options); }), HasSubstr(value));
      continue;
    }
    if (what == "unreadable") {
      EXPECT_EQ(refusal_by<DataError>([&] { open_snapshot(path, options); }), "");
      EXPECT_THAT(refusal_of_all<DataError>(path, options), HasSubstr(value));
      continue;
    }
    if (what == "misuse") {
      EXPECT_THAT(refusal_of_all<UsageError>(path, options), HasSubstr(value));
      continue;
    }
    if (!snapshot) snapshot = open_snapshot(path, options);
    if (!expect_of_all(*snapshot, what, value)) expect_of_type(*snapshot, what, value);
  }
}

TEST_P(SnapshotFile, IsReadOrRefused) {
  const TemporaryFolder folder;
  for (const std::string& content : GetParam().contents) {
    SCOPED_TRACE(content);
    write_bytes(folder / "snap", content);
    expect_snapshot(folder / "snap", GetParam().options, GetParam().expected);
  }
}

}  // namespace splotchcl::test
