#include "load/component_rows.h"

#include "load/particles.h"
#include "splotchcl/scene_file.h"
#include "text_rows.h"

namespace splotchcl::test {
namespace {

std::string first_word(std::string& text) {
  const std::size_t blank = text.find(' ');
  const std::string word = text.substr(0, blank);
  text = blank == std::string::npos ? "" : text.substr(blank + 1);
  return word;
}

Vec3 vector_of(const std::string& text) {
  Vec3 vector;
  std::istringstream(text) >> vector.a[0] >> vector.a[1] >> vector.a[2];
  return vector;
}

NumberedSnapshot snapshot_of(const std::vector<std::string>& row) {
  NumberedSnapshot snapshot = gas_row();
  std::size_t count = 6;
  for (std::string value : row) {
    if (first_word(value) != "given") continue;
    const std::string what = first_word(value);
    if (value == "particles") {
      count = std::stoul(what);
      snapshot = gas_row(static_cast<int>(count));
    } else if (what == "origin") {
      snapshot.set_origin(vector_of(value));
    } else if (what == "box") {
      snapshot.set_box_size(std::stod(value));
    } else {
      const std::vector<float> values = numbers_in<float>(value);
      snapshot.add(0, what, values, values.size() == 3 * count ? 3 : 1);
    }
  }
  return snapshot;
}

// Its other keys are those of scene_of and gas in load/particles.h.
Scene scene_of_text(const std::string& text) {
  const std::string palette =
      ("\n" + text).find("\npalette") == std::string::npos ? "palette = 'white'" : "";
  return parse_scene(
      "snapshot = 's'\n[image]\nsize = [64, 48]\n[camera]\nposition = [0, -20, 0]\n"
      "look_at = [0, 0, 0]\nsky = [0, 0, 1]\n[[component]]\nname = 'gas'\n" +
          palette + "\n" + text,
      "scene.toml");
}

const Column& column_of(const Particles& particles, const std::string& name) {
  const std::map<std::string, const Column*> columns = {
      {"weight", &particles.weight},
      {"position", &particles.position},
      {"smoothing_length", &particles.smoothing_length},
      {"color", &particles.color},
      {"intensity", &particles.intensity},
      {"sort_field", &particles.sort_field},
      {"color_vector", &particles.color_vector}};
  return *columns.at(name);
}

void expect(const DrawnComponent& drawn, const std::vector<std::string>& notes, std::string value) {
  SCOPED_TRACE(value);
  const std::string what = first_word(value);
  if (what == "note") {
    EXPECT_THAT(notes, Contains(HasSubstr(value)));
  } else if (what == "no" && value == "notes") {
    EXPECT_THAT(notes, IsEmpty());
  } else if (what == "no") {
    EXPECT_EQ(first_word(value), "note");
    EXPECT_THAT(notes, Not(Contains(HasSubstr(value))));
  } else if (what == "count") {
    EXPECT_EQ(std::to_string(drawn.particles.count), value);
  } else if (what == "range") {
    const std::vector<float> range = numbers_in<float>(value);
    EXPECT_NEAR(drawn.color.minimum, static_cast<double>(range.at(0)), 1e-6);
    EXPECT_NEAR(drawn.color.maximum, static_cast<double>(range.at(1)), 1e-6);
  } else {
    EXPECT_EQ(values(column_of(drawn.particles, what)), numbers_in<float>(value));
  }
}

}  // namespace

std::vector<TextRow> component_rows(const std::string& file) {
  return read_text_rows(source_folder() / "tests" / file);
}

TEST_P(ComponentKeys, AreLoadedOrRefused) {
  const NumberedSnapshot snapshot = snapshot_of(GetParam().expected);
  for (const std::string& text : GetParam().texts) {
    SCOPED_TRACE(text);
    DrawnComponent drawn;
    std::vector<std::string> notes;
    const std::string refused = refusal_by<Error>(
        [&] { drawn = load_frame(scene_of_text(text), snapshot, notes).components.at(0); });
    bool may_be_refused = false;
    for (const std::string& part : GetParam().expected) {
      if (part.rfind("given ", 0) == 0) continue;
      const bool is_of_refusal = part.rfind("refused ", 0) == 0;
      may_be_refused |= is_of_refusal;
      if (is_of_refusal) {
        EXPECT_THAT(refused, HasSubstr(part.substr(8)));
      } else {
        expect(drawn, notes, part);
      }
    }
    EXPECT_EQ(refused.empty(), !may_be_refused) << refused;
  }
}

}  // namespace splotchcl::test
