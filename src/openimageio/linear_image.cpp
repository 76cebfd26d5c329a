#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "openimageio/pictures.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double usual_gamma = 2.2;
constexpr int rows_in_band = 64;

bool is_stored_as_floats(const OIIO::ImageSpec& spec) {
  return spec.format.is_floating_point();
}

// Reads a picture's values from top to bottom, a band of whole rows at a time. Whole numbers
// come as 16 bits, so that a table turns them into light.
class BandReader {
 public:
  explicit BandReader(const std::filesystem::path& path) : path_(path) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);  // premultiplied light, not stored values
    input_ = open_image(path, &hints);
    spec_ = input_->spec();
    places_ = find_channels(spec_);
    alpha_multiplies_ = spec_.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  }

  const OIIO::ImageSpec& spec() const { return spec_; }
  const ChannelPlaces& places() const { return places_; }
  bool alpha_multiplies() const { return alpha_multiplies_; }
  // Tiles cannot be read in part.
  int band_height() const {
    return spec_.tile_height > 0 ? spec_.tile_height : std::min(rows_in_band, spec_.height);
  }

  template <typename T>
  void read(int first_row, int rows, OIIO::TypeDesc type, std::vector<T>& values) {
    values.resize(static_cast<std::size_t>(spec_.nchannels) *
                  static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(rows));
    const int begin = spec_.y + first_row;
    const bool good =
        spec_.tile_height > 0
            ? input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, begin, begin + rows, spec_.z,
                                 spec_.z + 1, 0, spec_.nchannels, type, values.data())
            : input_->read_scanlines(0, 0, begin, begin + rows, spec_.z, 0, spec_.nchannels, type,
                                     values.data());
    if (!good || input_->has_error()) {
      throw DataError(path_.string() + ": is damaged: " + first_line(input_->geterror()));
    }
  }

 private:
  std::filesystem::path path_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
  ChannelPlaces places_;
  bool alpha_multiplies_ = false;
};

// Light by stored value of 16 bits.
std::vector<float> light_table(double gamma) {
  constexpr std::size_t values = 65536;
  std::vector<float> table(values);
  for (std::size_t i = 0; i < values; ++i) {
    table[i] = static_cast<float>(std::pow(static_cast<double>(i) / (values - 1), gamma));
  }
  return table;
}

// Sums over squares of `side` pixels of the file.
class Averager {
 public:
  Averager(int width, int height, int side)
      : side_(side),
        width_(width),
        height_(height),
        image_((width + side - 1) / side, (height + side - 1) / side),
        sums_(image_.pixels.size()) {}

  void add(int x, int y, const float (&rgba)[4]) {
    const std::size_t pixel =
        static_cast<std::size_t>(y / side_) * static_cast<std::size_t>(image_.width) +
        static_cast<std::size_t>(x / side_);
    for (std::size_t i = 0; i < 4; ++i)
      sums_[4 * pixel + i] += static_cast<double>(rgba[i]);
  }

  Image finish() && {
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        // The last row and column of squares may be cut by the picture's edge.
        const double count = static_cast<double>(std::min(side_, width_ - x * side_)) *
                             static_cast<double>(std::min(side_, height_ - y * side_));
        float* const pixel = image_.at(x, y);
        const auto first = static_cast<std::size_t>(pixel - image_.pixels.data());
        for (std::size_t i = 0; i < 4; ++i)
          pixel[i] = static_cast<float>(sums_[first + i] / count);
      }
    }
    return std::move(image_);
  }

 private:
  int side_, width_, height_;
  Image image_;
  std::vector<double> sums_;
};

int square_side(const OIIO::ImageSpec& spec, int longest_side) {
  if (longest_side <= 0) return 1;
  const int longest = std::max(spec.width, spec.height);
  return (longest + longest_side - 1) / longest_side;
}

// Calls visit(x, y, values of the pixel) for every pixel.
template <typename T, typename Visit>
void for_each_pixel(BandReader& reader, OIIO::TypeDesc type, Visit&& visit) {
  const OIIO::ImageSpec& spec = reader.spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<T> values;
  for (int first = 0; first < spec.height; first += reader.band_height()) {
    const int rows = std::min(reader.band_height(), spec.height - first);
    reader.read(first, rows, type, values);
    const T* pixel = values.data();
    for (int y = first; y < first + rows; ++y) {
      for (int x = 0; x < spec.width; ++x, pixel += channels)
        visit(x, y, pixel);
    }
  }
}

void add_whole_numbers(BandReader& reader, double gamma, Averager& sums) {
  const std::vector<float> table = light_table(gamma);
  const ChannelPlaces places = reader.places();
  for_each_pixel<std::uint16_t>(
      reader, OIIO::TypeDesc::UINT16, [&](int x, int y, const std::uint16_t* from) {
        const float alpha =
            places.alpha < 0 ? 1.0F : static_cast<float>(from[places.alpha]) / 65535.0F;
        const float factor = reader.alpha_multiplies() ? alpha : 1.0F;
        sums.add(x, y,
                 {factor * table[from[places.color[0]]], factor * table[from[places.color[1]]],
                  factor * table[from[places.color[2]]], alpha});
      });
}

void add_floats(BandReader& reader, double gamma, const std::filesystem::path& path,
                Averager& sums) {
  const ChannelPlaces places = reader.places();
  for_each_pixel<float>(reader, OIIO::TypeDesc::FLOAT, [&](int x, int y, const float* from) {
    const float alpha = places.alpha < 0 ? 1.0F : from[places.alpha];
    float rgba[4] = {0, 0, 0, alpha};
    for (std::size_t i = 0; i < 3; ++i) {
      const float value = from[places.color[i]];
      const bool has_light = std::isfinite(value) && (gamma == 1 || value >= 0);
      if (!has_light || !std::isfinite(alpha)) {
        throw DataError(path.string() + ": holds " + std::to_string(value) + " at pixel " +
                        std::to_string(x) + "," + std::to_string(y) +
                        ", expected a finite amount of light >= 0; repair the picture");
      }
      const float light =
          gamma == 1 ? value : static_cast<float>(std::pow(static_cast<double>(value), gamma));
      rgba[i] = reader.alpha_multiplies() ? alpha * light : light;
    }
    sums.add(x, y, rgba);
  });
}

}  // namespace

Image read_linear(const std::filesystem::path& path, const LinearImageOptions& options) {
  BandReader reader(path);
  const OIIO::ImageSpec& spec = reader.spec();
  const bool floats = is_stored_as_floats(spec);
  const double gamma = options.gamma.value_or(floats ? 1.0 : usual_gamma);
  Averager sums(spec.width, spec.height, square_side(spec, options.longest_side));
  if (floats) {
    add_floats(reader, gamma, path, sums);
  } else {
    add_whole_numbers(reader, gamma, sums);
  }
  return std::move(sums).finish();
}

}  // namespace splotchcl
