// The C interface, its functions in any order with any arguments that a caller could hand over
// without breaking C's own rules: null pointers, wrong types, counts and numbers, images of any
// room.
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "fuzz/fuzz.h"
#include "splotchcl/splotchcl_c.h"

namespace {

// What is taken from the input; zeros at its end.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}
  bool is_empty() const { return next_ == end_; }
  unsigned number(unsigned below) { return byte() % below; }
  std::string text() {
    std::string text;
    for (unsigned length = number(64); length > 0; --length)
      text += static_cast<char>(byte());
    return text;
  }
  double any_double() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr std::array<double, 8> values = {
        0, 1, -1, 2.2, inf, -inf, std::numeric_limits<double>::quiet_NaN(), 1e300};
    return values[number(values.size())];
  }

 private:
  std::uint8_t byte() { return is_empty() ? std::uint8_t{0} : *next_++; }
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

constexpr std::size_t most_particles = 8;
constexpr std::array<const char*, 10> fields = {
    "position", "Coordinates",     "mass",  "density", "smoothing_length",
    "velocity", "internal_energy", "Color", "",        nullptr};
constexpr std::array<const char*, 12> settings = {"image.size=[8,6]",
                                                  "image.size=[9,300]",
                                                  "stereo.separation=0.1",
                                                  "camera.projection=cube",
                                                  "component.0.types=[0,1]",
                                                  "component.0.absorption=none",
                                                  "component.0.color.field=mass",
                                                  "component.0.size.fixed=0.5",
                                                  "tolerance=0",
                                                  "periodic.wrap=true",
                                                  "finish.title=\"{time:.3f}\"",
                                                  nullptr};

// The caller, who owns arrays that live as long as all objects.
class Caller {
 public:
  Caller() : floats_(3 * most_particles), doubles_(3 * most_particles), image_(4 * 64 * 64) {
    for (std::size_t i = 0; i < floats_.size(); ++i) {
      floats_[i] = static_cast<float>(i % 7) - 3;
      doubles_[i] = static_cast<double>(i % 5);
    }
    floats_[4] = std::numeric_limits<float>::quiet_NaN();
  }
  ~Caller() {
    splotchcl_scene_free(scene_);
    splotchcl_particles_free(particles_);
    splotchcl_renderer_free(renderer_);
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  void call(Choices& c) {
    splotchcl_error error = {-1, "x"};
    splotchcl_error* const e = c.number(8) == 0 ? nullptr : &error;
    call_one(c, e);
    if (e == nullptr || error.code == -1) return;
    if (error.code < 0 || error.code > 2) std::abort();
    if ((error.code == 0) != (error.message[0] == '\0')) std::abort();
    if (std::strchr(error.message, '\n') != nullptr) std::abort();
  }

 private:
  void call_one(Choices& c, splotchcl_error* e) {
    switch (c.number(15)) {
      case 0: {
        splotchcl_scene_free(scene_);
        const std::string text = "[image]\nsize=[8,6]\n[[component]]\n" + c.text();
        scene_ = c.number(9) == 0 ? nullptr : splotchcl_scene_from_text(text.c_str(), e);
        return;
      }
      case 1:
        splotchcl_scene_free(splotchcl_scene_from_file(c.text().c_str(), e));
        return;
      case 2:
        splotchcl_scene_set(scene_, settings[c.number(settings.size())], e);
        return;
      case 3:
        splotchcl_scene_set(scene_, c.text().c_str(), e);
        return;
      case 4: {
        int width = 0, height = 0;
        splotchcl_scene_picture_size(scene_, c.number(9), &width,
                                     c.number(5) == 0 ? nullptr : &height, e);
        return;
      }
      case 5:
        splotchcl_scene_decide(scene_, particles_, e);
        return;
      case 6:
        splotchcl_particles_free(particles_);
        particles_ = c.number(9) == 0 ? nullptr : splotchcl_particles_new();
        return;
      case 7:
      case 8:
        set_field(c, e);
        return;
      case 9:
        splotchcl_particles_set_mass(particles_, type(c), c.any_double(), e);
        return;
      case 10:
        splotchcl_particles_clear(particles_, type(c), e);
        return;
      case 11:
        splotchcl_particles_set_box_size(particles_, c.any_double(), e);
        return;
      case 12:
        if (renderer_ == nullptr) renderer_ = splotchcl_renderer_new(nullptr, e);
        return;
      case 13:
        draw(c, e);
        return;
      default:
        splotchcl_write_image(c.number(2) == 0 ? "/dev/null/no.png" : "nothing", image_.data(),
                              static_cast<int>(c.number(40)) - 4,
                              static_cast<int>(c.number(40)) - 4, c.any_double(), e);
    }
  }

  static int type(Choices& c) { return static_cast<int>(c.number(36)) - 2; }

  void set_field(Choices& c, splotchcl_error* e) {
    constexpr std::array<std::uint64_t, 4> too_many = {UINT64_MAX, UINT64_MAX / 3 + 1,
                                                       UINT64_MAX / 12 + 1, std::uint64_t{1} << 62};
    const int of_type = c.number(3) == 0 ? type(c) : static_cast<int>(c.number(2));
    const char* const field = fields[c.number(fields.size())];
    const std::uint64_t count =
        c.number(6) == 0 ? too_many[c.number(too_many.size())] : c.number(most_particles + 1);
    const int width = c.number(4) == 0 ? static_cast<int>(c.number(5)) - 1 : 3;
    const bool is_null = c.number(9) == 0;
    if (c.number(9) == 0) {
      const auto* const integers = reinterpret_cast<const std::int64_t*>(doubles_.data());
      splotchcl_particles_set_integers(particles_, of_type, field, is_null ? nullptr : integers,
                                       count, e);
    } else if (c.number(2) == 0) {
      splotchcl_particles_set_floats(particles_, of_type, field, is_null ? nullptr : floats_.data(),
                                     count, width, e);
    } else {
      splotchcl_particles_set_doubles(particles_, of_type, field,
                                      is_null ? nullptr : doubles_.data(), count, width, e);
    }
  }

  // Large pictures would take all the time.
  void draw(Choices& c, splotchcl_error* e) {
    const std::size_t count = splotchcl_scene_picture_count(scene_);
    std::vector<float*> images(count + 1, image_.data());
    std::vector<std::size_t> capacities(count + 1, image_.size());
    if (c.number(4) == 0) capacities[0] = c.number(200);
    if (c.number(9) == 0) images[0] = nullptr;
    splotchcl_draw(renderer_, scene_, particles_, images.data(), capacities.data(),
                   count + (c.number(9) == 0 ? 1 : 0), e);
    const std::string notes = splotchcl_renderer_notes(renderer_);
    if (!notes.empty() && notes.back() != '\n') std::abort();
  }

  std::vector<float> floats_;
  std::vector<double> doubles_;
  std::vector<float> image_;
  splotchcl_scene* scene_ = nullptr;
  splotchcl_particles* particles_ = nullptr;
  splotchcl_renderer* renderer_ = nullptr;
};

}  // namespace

void splotchcl::fuzz::fuzz_c_interface(const std::uint8_t* data, std::size_t size) {
  constexpr int most_calls = 64;
  Choices choices(data, size);
  Caller caller;
  for (int i = 0; i < most_calls && !choices.is_empty(); ++i)
    caller.call(choices);
}
