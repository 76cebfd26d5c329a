#include <variant>

#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {
namespace {

ValueType<std::array<double, 2>> sky_place() {
  using Pair = std::array<double, 2>;
  const auto read = [](const toml::node& node) -> std::optional<Pair> {
    const auto pair = two_numbers(between(-90, 360), "").read(node);
    if (!pair || (*pair)[0] < 0 || (*pair)[1] > 90) return std::nullopt;
    return pair;
  };
  return {"[right ascension from 0 to 360, declination from -90 to 90]", read,
          two_numbers({}, "").write};
}

ValueType<std::vector<double>> numbers() {
  const auto read = [](const toml::node& node) -> std::optional<std::vector<double>> {
    const toml::array* const array = node.as_array();
    if (array == nullptr) return std::nullopt;
    std::vector<double> values;
    for (const toml::node& element : *array) {
      const auto value = number().read(element);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
    return values;
  };
  const auto write = [](const std::vector<double>& values) {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + write_number(value);
    return "[" + text + "]";
  };
  return {"an array of finite numbers", read, write};
}

// A length as the snapshot's number, or as a text with a unit of its own (MapSettings).
Key length_key(const char* name, std::optional<double> MapSettings::*member, const Text& meaning) {
  using Length = std::variant<double, std::string>;
  const auto read = [](const toml::node& node) -> std::optional<Length> {
    if (const auto value = number(more_than(0)).read(node)) return *value;
    const auto words = text().read(node);
    return words ? std::optional<Length>(*words) : std::nullopt;
  };
  const auto write = [](const Length& length) {
    const auto* const words = std::get_if<std::string>(&length);
    return words != nullptr ? write_text(*words) : write_number(std::get<double>(length));
  };
  return key<MapSettings, Length>(
      std::string("map.") + name,
      {number(more_than(0)).expected + ", or a length such as \"4 Mpc\"", read, write},
      [name, member](const MapSettings& map) -> std::optional<Length> {
        const auto found = map.lengths_with_units.find(name);
        if (found != map.lengths_with_units.end()) return found->second;
        return map.*member ? std::optional<Length>(*(map.*member)) : std::nullopt;
      },
      [name, member](MapSettings& map, const Length& length) {
        map.lengths_with_units.erase(name);
        if (const auto* const words = std::get_if<std::string>(&length)) {
          map.lengths_with_units[name] = *words;
        } else {
          map.*member = std::get<double>(length);
        }
      },
      meaning);
}

// Numbers, or a text such as "25,25,25Mpc".
template <class V>
Key lengths_key(const char* name, const ValueType<V>& numbers_of, const char* example,
                std::optional<V> MapSettings::*member, const Text& meaning) {
  using Lengths = std::variant<V, std::string>;
  const auto read = [read_numbers =
                         numbers_of.read](const toml::node& node) -> std::optional<Lengths> {
    if (const auto values = read_numbers(node)) return Lengths(*values);
    const auto words = text().read(node);
    // A setting that is no array of as many numbers comes again as a text.
    const bool is_array = words && words->find('[') != std::string::npos;
    return words && !is_array ? std::optional<Lengths>(*words) : std::nullopt;
  };
  const auto write = [write_numbers = numbers_of.write](const Lengths& lengths) {
    const auto* const words = std::get_if<std::string>(&lengths);
    return words != nullptr ? write_text(*words) : write_numbers(std::get<V>(lengths));
  };
  return key<MapSettings, Lengths>(
      std::string("map.") + name,
      {numbers_of.expected + ", or lengths such as \"" + example + "\"", read, write},
      [name, member](const MapSettings& map) -> std::optional<Lengths> {
        const auto found = map.lengths_with_units.find(name);
        if (found != map.lengths_with_units.end()) return found->second;
        return map.*member ? std::optional<Lengths>(*(map.*member)) : std::nullopt;
      },
      [name, member](MapSettings& map, const Lengths& lengths) {
        map.lengths_with_units.erase(name);
        if (const auto* const words = std::get_if<std::string>(&lengths)) {
          map.lengths_with_units[name] = *words;
        } else {
          map.*member = std::get<V>(lengths);
        }
      },
      meaning);
}

// A number alone stands for all.
template <std::size_t size>
ValueType<std::array<int, size>> counts(int at_least, const std::string& expected) {
  constexpr int at_most = 8192;
  using Counts = std::array<int, size>;
  const auto read = [at_least](const toml::node& node) -> std::optional<Counts> {
    Counts values{};
    if (const auto one = integer(at_least, at_most).read(node)) {
      values.fill(*one);
      return values;
    }
    const toml::array* const array = node.as_array();
    if (array == nullptr || array->size() != size) return std::nullopt;
    for (std::size_t i = 0; i < size; ++i) {
      const auto one = integer(1, at_most).read((*array)[i]);
      if (!one) return std::nullopt;
      values[i] = *one;
    }
    return values;
  };
  const auto write = [](const Counts& values) {
    std::string text;
    for (const int value : values)
      text += (text.empty() ? "" : ", ") + std::to_string(value);
    return values[0] == 0 ? "0" : "[" + text + "]";
  };
  return {expected, read, write};
}

// A text that says nothing where it is empty.
Key text_key(const std::string& name, std::string MapSettings::*member, const Text& meaning) {
  return key<MapSettings, std::string>(
      "map." + name, text(),
      [member](const MapSettings& map) {
        return (map.*member).empty() ? std::nullopt : std::optional(map.*member);
      },
      [member](MapSettings& map, const std::string& value) { map.*member = value; }, meaning);
}

Keys quantity_keys() {
  return {
      text_key("component", &MapSettings::component,
               {"The component whose particles the map shows, by its name.", "", "the first"}),
      text_key("quantity", &MapSettings::quantity,
               {"`surface_density`, `counts`, `line_of_sight_velocity`, or a field."}),
      key("map.statistic",
          choice<MapStatistic>({{"mean", MapStatistic::mean},
                                {"dispersion", MapStatistic::dispersion},
                                {"integral", MapStatistic::integral}}),
          &MapSettings::statistic,
          {"Along each line of sight: the field's weighted mean, its standard deviation, or its "
           "integral."}),
      text_key("weight", &MapSettings::weight,
               {"The weights of means: `mass`, `volume`, `constant` (all particles alike), or a "
                "field of values >= 0.",
                "", "`\"mass\"`; of a slice `\"volume\"`"}),
      key("map.slice", boolean(), &MapSettings::slice,
          {"In the plane through the centre, instead of along the line of sight."}),
  };
}

Keys velocity_keys() {
  return {
      key("map.channels", integer(0, 4096), &MapSettings::channels,
          {"A sum in so many channels of velocity along the line of sight, as a cube, in place of "
           "a "
           "map."}),
      key("map.velocity_range", two_numbers({}, "[from, to]"), &MapSettings::velocity_range,
          {"From the first to the last channel.", "the snapshot's", "that of all particles"}),
      key("map.line_mass", number(at_least(0)), &MapSettings::line_mass,
          {"Lines are as wide as the thermal motion of particles of so many proton masses makes "
           "them; 0: a particle has one velocity."}),
  };
}

Keys shape_keys() {
  return {
      key("map.healpix", integer(0, 8192), &MapSettings::healpix,
          {"A map of the sphere around the centre: its NSIDE."}),
      key("map.healpix_order",
          choice<HealpixOrder>({{"ring", HealpixOrder::ring}, {"nested", HealpixOrder::nested}}),
          &MapSettings::healpix_order, {"How its pixels are numbered."}),
      lengths_key<std::array<double, 2>>(
          "shell", two_numbers({}, "[from, to]"), "10,20Mpc", &MapSettings::shell,
          {"Distances from the centre: of particles of a sphere or sky, of a profile's shells.",
           "length", "all (maps.md)"}),
      key("map.tile", boolean(), &MapSettings::tile,
          {"A sphere or sky has every periodic image in `shell`."}),
      key("map.voxels", counts<3>(0, "a number, or [NX, NY, NZ], up to 8192"), &MapSettings::voxels,
          {"A cube of voxels; `width` is along x."}),
      key("map.profile", integer(0, 100000), &MapSettings::profile,
          {"A radial profile in this many shells."}),
      key("map.histogram", texts(), &MapSettings::histogram,
          {"Of two fields, the first to the right.", "", "none"}),
      key("map.bins", counts<2>(1, "a number, or [X, Y], up to 8192"), &MapSettings::bins,
          {"Of the histogram."}),
      key("map.x_range", two_numbers({}, "[from, to]"), &MapSettings::x_range,
          {"Of its first field.", "the field's", "all"}),
      key("map.y_range", two_numbers({}, "[from, to]"), &MapSettings::y_range,
          {"Of its second field.", "the field's", "all"}),
  };
}

Keys view_keys() {
  return {
      key("map.view",
          choice<MapView>({{"xy", MapView::xy},
                           {"xz", MapView::xz},
                           {"yz", MapView::yz},
                           {"camera", MapView::camera},
                           {"sky", MapView::sky}}),
          &MapSettings::view,
          {"The axes to the right and upwards; `camera`: as the scene's camera looks; `sky`: from "
           "the "
           "centre."}),
      lengths_key<Vec3>("center", vector(), "25,25,25Mpc", &MapSettings::center,
                        {"The middle of the map.", "length", "what `center_at` says"}),
      key("map.center_at",
          choice<MapCenter>({{"box", MapCenter::box},
                             {"mass", MapCenter::mass},
                             {"densest", MapCenter::densest}}),
          &MapSettings::center_at,
          {"Without a `center`: the middle of the box or of the particles, the centre of mass, or "
           "the densest particle. With the view `camera`, `box` is its look-at point."}),
      length_key("width", &MapSettings::width,
                 {"Between the left and right edges; of a sky in degrees.", "length",
                  "all of the box, or of the particles"}),
      length_key(
          "depth", &MapSettings::depth,
          {"Only particles whose centres lie within half of it from the centre along the line of "
           "sight.",
           "length", "one side of a periodic box; otherwise no limit"}),
      text_key("axis_unit", &MapSettings::axis_unit,
               {"The unit of coordinates in files and figures, such as `Mpc`.", "",
                "the largest that the map is as wide as"}),
      key("map.periodic", boolean(), &MapSettings::periodic,
          {"Draw every periodic image of a particle that the map shows.", "",
           "whether the snapshot has a box that its particles lie in"}),
      key("map.size_factor", number(more_than(0)), &MapSettings::size_factor,
          {"Factor on smoothing lengths; `component.size.factor` does not count in maps."}),
  };
}

Keys number_keys() {
  return {
      text_key("unit", &MapSettings::unit,
               {"The map's unit, such as `Msun/pc^2`; `a` and `h` are the snapshot's.", "",
                "what the snapshot's units give"}),
      text_key("length_unit", &MapSettings::length_unit,
               {"The snapshot's unit of length if the file names none: `a kpc/h`.", "",
                "the snapshot's"}),
      text_key("mass_unit", &MapSettings::mass_unit,
               {"Likewise: `1e10 Msun/h`.", "", "the snapshot's"}),
      text_key("velocity_unit", &MapSettings::velocity_unit,
               {"Likewise: `km/s`.", "", "the snapshot's"}),
      key("map.floor", number(between(1e-12, 1)), &MapSettings::floor,
          {"If the column of the weights is below this fraction of its mean, a mean is NaN, and "
           "the tolerance is relative to this column."}),
      key("map.noise", boolean(), &MapSettings::noise,
          {"A second plane: the effective number of particles."}),
  };
}

Keys sky_keys() {
  return {
      text_key("distance", &MapSettings::distance,
               {"From where the centre is seen, such as `16.5 Mpc` or `redshift`: adds coordinates "
                "on the sky to FITS and HDF5.",
                "", "not on the sky"}),
      key("map.sky", sky_place(), &MapSettings::sky,
          {"Right ascension and declination of the centre. North is up.", "degrees"}),
  };
}

Keys figure_keys() {
  return {
      key("map.scaling",
          choice<MapScaling>({{"linear", MapScaling::linear},
                              {"log", MapScaling::log},
                              {"asinh", MapScaling::asinh},
                              {"power", MapScaling::power}}),
          &MapSettings::scaling,
          {"In figures: from values to the palette.", "",
           "`log`; of values of both signs `linear` or `asinh` (maps.md)"}),
      key("map.softening", number(more_than(0)), &MapSettings::softening,
          {"Below it asinh is linear.", "the map's",
           "a thousandth of the limit farther from 0, down to a power of ten"}),
      key("map.exponent", number(between(0.01, 10)), &MapSettings::exponent,
          {"For the scaling `power`: 0.5 is the square root."}),
      key("map.min", number(), &MapSettings::minimum,
          {"The value of the palette's first colour.", "the map's",
           "a percentile of the map; of a logarithm no less than the map's floor"}),
      key("map.max", number(), &MapSettings::maximum,
          {"The value of its last colour.", "the map's", "a percentile of the map"}),
      key("map.percentiles", percentiles(), &MapSettings::percentiles,
          {"Percentiles of the map for a missing min or max.", "per cent", "`[1, 99.9]`"}),
      text_key("palette", &MapSettings::palette, {"The name of a palette, or a file."}),
      excluding(key("map.contours", numbers(), &MapSettings::contours,
                    {"Lines at these values of the map.", "the map's", "none"}),
                {"map.contour_count"}),
      key("map.contour_count", integer(0, 100), &MapSettings::contour_count,
          {"This many lines, evenly spaced in the palette."}),
  };
}

}  // namespace

Keys map_keys() {
  Keys keys;
  for (const Keys& part : {quantity_keys(), velocity_keys(), shape_keys(), view_keys(),
                           number_keys(), sky_keys(), figure_keys()})
    append(keys, part);
  return written_if_set(std::move(keys));
}

}  // namespace splotchcl::scene_file
