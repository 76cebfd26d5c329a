#include <limits>

#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {
namespace {

// `member` gives a reference to the member, of const settings and of others: the value
// itself or an optional one.
template <class V, class Member>
Key finish_key(const std::string& path, const ValueType<V>& type, Member member, const Text& text) {
  return key<FinishSettings, V>(
      "finish." + path, type,
      [member](const FinishSettings& finish) { return std::optional<V>(member(finish)); },
      [member](FinishSettings& finish, const V& value) { member(finish) = value; }, text);
}

// Text that is empty where there is none.
template <class Member>
Key text_key(const std::string& path, const ValueType<std::string>& type, Member member,
             const Text& text_of_key) {
  return key<FinishSettings, std::string>(
      "finish." + path, type,
      [member](const FinishSettings& finish) {
        const std::string& value = member(finish);
        return value.empty() ? std::nullopt : std::optional(value);
      },
      [member](FinishSettings& finish, const std::string& value) { member(finish) = value; },
      text_of_key);
}

// Each letter is drawn.
ValueType<std::string> shown_words() {
  constexpr std::size_t most_bytes = 2000, most_lines = 50;
  return words(most_bytes, most_lines);
}

ValueType<Anchor> anchor() {
  return choice<Anchor>({{"top left", Anchor::top_left},
                         {"top", Anchor::top},
                         {"top right", Anchor::top_right},
                         {"left", Anchor::left},
                         {"right", Anchor::right},
                         {"bottom left", Anchor::bottom_left},
                         {"bottom", Anchor::bottom},
                         {"bottom right", Anchor::bottom_right}});
}

ValueType<DisplayColor> display_color() {
  return three_numbers(between(0, 1), "[red, green, blue]");
}

ValueType<double> text_height() {
  return number(between(0.001, 0.5));
}

Text where(const std::string& what) {
  return {"Where " + what + "."};
}

// Unset: found from the picture.
ValueType<std::optional<double>> number_or_auto(const Range& range) {
  using Value = std::optional<double>;
  const ValueType<double> plain = number(range);
  return {"\"auto\" or " + plain.expected,
          [plain](const toml::node& node) -> std::optional<Value> {
            if (node.value_exact<std::string>() == "auto") return Value();
            const std::optional<double> value = plain.read(node);
            return value ? std::optional<Value>(value) : std::nullopt;
          },
          [](const Value& value) { return value ? write_number(*value) : "\"auto\""; }};
}

struct Exposure {
  std::optional<double> stops;
  bool follows = false;
};

// Unset: found from the picture, for a film once or all along it.
ValueType<Exposure> exposure() {
  const ValueType<std::optional<double>> plain = number_or_auto(between(-100, 100));
  return {"\"follow\" or " + plain.expected,
          [plain](const toml::node& node) -> std::optional<Exposure> {
            if (node.value_exact<std::string>() == "follow") return Exposure{std::nullopt, true};
            const auto value = plain.read(node);
            return value ? std::optional(Exposure{*value, false}) : std::nullopt;
          },
          [plain](const Exposure& value) {
            return value.follows && !value.stops ? "\"follow\"" : plain.write(value.stops);
          }};
}

Key exposure_key() {
  return key<FinishSettings, Exposure>(
      "finish.exposure", exposure(),
      [](const FinishSettings& finish) {
        return std::optional(Exposure{finish.exposure, finish.exposure_follows});
      },
      [](FinishSettings& finish, const Exposure& value) {
        finish.exposure = value.stops;
        finish.exposure_follows = value.follows;
      },
      {"Light is multiplied by 2^exposure. `\"auto\"`: from the picture, of a film once; "
       "`\"follow\"`: slowly along a film; see finish.md.",
       "stops"});
}

Keys tone_keys() {
  return {
      exposure_key(),
      finish_key("tone",
                 choice<ToneCurve>({{"linear", ToneCurve::linear},
                                    {"asinh", ToneCurve::asinh},
                                    {"filmic", ToneCurve::filmic}}),
                 [](auto& f) -> auto& { return f.tone; },
                 {"The curve that fits light to a display; `asinh` and `filmic` keep detail in "
                  "bright and dark. See finish.md."}),
      finish_key("white", number_or_auto(between(1e-30, 1e30)),
                 [](auto& f) -> auto& { return f.white; },
                 {"Light, after exposure, that becomes the display's white. `\"auto\"`: from the "
                  "picture; see finish.md.",
                  "white is 1"}),
  };
}

// Nothing where it is left out.
Key white_balance_key() {
  return key<FinishSettings, double>(
      "finish.white_balance", number(between(1667, 25000)),
      [](const FinishSettings& finish) { return finish.white_balance; },
      [](FinishSettings& finish, double value) { finish.white_balance = value; },
      {"The light of a black body so hot becomes white: below 6500 the picture turns bluer, above "
       "redder.",
       "K", "as drawn"});
}

Keys light_keys() {
  return {
      finish_key("bloom", number(between(0, 1)), [](auto& f) -> auto& { return f.bloom; },
                 {"The part of light that glows around where it falls, as in a lens; see "
                  "finish.md."}),
      white_balance_key(),
      finish_key("highlights", number(between(0, 1)), [](auto& f) -> auto& { return f.highlights; },
                 {"0: bright light keeps its hue. 1: it turns white as it nears white."}),
      finish_key("saturation", number(between(0, 100)),
                 [](auto& f) -> auto& { return f.saturation; }, {"0 is grey, 1 as drawn."}),
      finish_key("contrast", number(between(0, 100)), [](auto& f) -> auto& { return f.contrast; },
                 {"A display value v becomes pivot (v / pivot)^contrast."}),
      finish_key("contrast_pivot", number(between(0.001, 1000)),
                 [](auto& f) -> auto& { return f.contrast_pivot; },
                 {"The display value that contrast leaves as it is."}),
  };
}

template <class Member>
Keys text_keys(const std::string& name, Member member, const std::string& what,
               const std::string& size) {
  return {
      text_key(name + ".text", shown_words(), [member](auto& f) -> auto& { return member(f).text; },
               {what + " Placeholders such as `{redshift:.2f}` are filled in; see finish.md.", "",
                "none"}),
      finish_key(
          name + ".at", anchor(), [member](auto& f) -> auto& { return member(f).at; },
          where("it lies")),
      finish_key(name + ".size",
                 text_height(), [member](auto& f) -> auto& { return member(f).size; },
                 {"Size of its letters.", "shorter side", size}),
  };
}

Keys all_text_keys() {
  Keys keys = {
      text_key(
          "font", text(), [](auto& f) -> auto& { return f.font; },
          {"The font of all text: a name such as DejaVuSans-Bold, or a font file (.ttf, .otf)."}),
      finish_key("text_size", text_height(), [](auto& f) -> auto& { return f.text_size; },
                 {"Size of letters.", "shorter side"}),
      finish_key("text_color", display_color(), [](auto& f) -> auto& { return f.text_color; },
                 {"Colour of text, ticks and the scale bar, as displayed."}),
      finish_key("frame", integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()),
                 [](auto& f) -> auto& { return f.frame; },
                 {"The number that `{frame}` stands for. Films set it.", "", "0"}),
  };
  append(keys,
         text_keys(
             "title", [](auto& f) -> auto& { return f.title; }, "A text.", "1.5 `text_size`"));
  append(keys,
         text_keys(
             "label", [](auto& f) -> auto& { return f.label; }, "Another text.", "`text_size`"));
  append(keys, text_keys(
                   "caption", [](auto& f) -> auto& { return f.caption; }, "A third text.",
                   "`text_size`"));
  return keys;
}

Keys bar_keys() {
  return {
      finish_key("color_bar.show", boolean(), [](auto& f) -> auto& { return f.color_bar.show; },
                 {"Draw the components' palettes with their values."}),
      finish_key(
          "color_bar.at", anchor(), [](auto& f) -> auto& { return f.color_bar.at; },
          where("the bars lie")),
      finish_key("color_bar.length", number(between(0.05, 1)),
                 [](auto& f) -> auto& { return f.color_bar.length; },
                 {"Length of all bars together.", "height or width"}),
      finish_key("color_bar.components", texts(),
                 [](auto& f) -> auto& { return f.color_bar.components; },
                 {"Names of the components that have a bar.", "", "all with a color.field"}),
      finish_key("color_bar.labels", texts(), [](auto& f) -> auto& { return f.color_bar.labels; },
                 {"A text for each bar.", "", "the field's name and unit"}),
      finish_key("scale_bar.show", boolean(), [](auto& f) -> auto& { return f.scale_bar.show; },
                 {"Draw a length as it appears at the look-at point."}),
      finish_key(
          "scale_bar.at", anchor(), [](auto& f) -> auto& { return f.scale_bar.at; },
          where("the bar lies")),
      finish_key("scale_bar.length", number(more_than(0)),
                 [](auto& f) -> auto& { return f.scale_bar.length; },
                 {"The length that is drawn.", "length", "a round one, a fifth of the picture"}),
      text_key("scale_bar.unit", shown_words(), [](auto& f) -> auto& { return f.scale_bar.unit; },
               {"What is written after the number.", "", "the unit of the snapshot's positions"}),
  };
}

Keys inset_keys() {
  const std::string same = "the picture's";
  return {
      finish_key("inset.show", boolean(), [](auto& f) -> auto& { return f.inset.show; },
                 {"Draw the scene as another camera sees it into a part of the picture."}),
      finish_key(
          "inset.at", anchor(), [](auto& f) -> auto& { return f.inset.at; },
          where("the inset lies")),
      finish_key("inset.size", two_numbers(between(0.01, 1), "[width, height]"),
                 [](auto& f) -> auto& { return f.inset.size; },
                 {"Its size, without the border.", "picture width, height"}),
      finish_key("inset.border", number(between(0, 0.2)),
                 [](auto& f) -> auto& { return f.inset.border; },
                 {"Width of the border.", "shorter side"}),
      finish_key("inset.border_color", display_color(),
                 [](auto& f) -> auto& { return f.inset.border_color; },
                 {"Colour of the border, as displayed."}),
      finish_key("inset.position", vector(), [](auto& f) -> auto& { return f.inset.position; },
                 {"Where its camera stands.", "length", same}),
      finish_key("inset.look_at", vector(), [](auto& f) -> auto& { return f.inset.look_at; },
                 {"The point in its middle.", "length", same}),
      finish_key("inset.sky", vector(), [](auto& f) -> auto& { return f.inset.sky; },
                 {"The direction shown upwards in it.", "", same}),
      finish_key("inset.field_of_view", number(field_of_view_range()),
                 [](auto& f) -> auto& { return f.inset.field_of_view_degrees; },
                 {"Horizontal angle of its view.", "degrees", same}),
      finish_key("inset.components", texts(), [](auto& f) -> auto& { return f.inset.components; },
                 {"Names of the components that it shows.", "", "all"}),
  };
}

Keys fade_keys() {
  return {
      text_key("cross_fade.scene", text(), [](auto& f) -> auto& { return f.cross_fade.scene; },
               {"A scene file whose picture is mixed into this one; see finish.md.", "", "none"}),
      finish_key("cross_fade.amount", number(between(0, 1)),
                 [](auto& f) -> auto& { return f.cross_fade.amount; },
                 {"0 is this scene alone, 1 the other alone."}),
      finish_key("fade", number(between(0, 1)), [](auto& f) -> auto& { return f.fade; },
                 {"0 is the picture, 1 is `fade_color` alone."}),
      finish_key("fade_color", display_color(), [](auto& f) -> auto& { return f.fade_color; },
                 {"What the picture fades to, as displayed."}),
  };
}

}  // namespace

Keys finish_keys() {
  Keys keys;
  for (const Keys& part :
       {tone_keys(), light_keys(), all_text_keys(), bar_keys(), inset_keys(), fade_keys()}) {
    append(keys, part);
  }
  return written_if_set(std::move(keys));
}

}  // namespace splotchcl::scene_file
