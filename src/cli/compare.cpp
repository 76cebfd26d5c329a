#include "splotchcl/compare.h"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "cli/commands.h"
#include "cli/json_answer.h"
#include "common/output_files.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"

namespace splotchcl::cli {
namespace {

constexpr std::array<const char*, 4> channel_names = {"red", "green", "blue", "alpha"};

const char* channel_name(int channel) {
  return channel_names[static_cast<std::size_t>(channel)];
}

// JSON has no infinity: equal pictures have a PSNR of null.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json to_json(const ChannelDifference& difference) {
  return {{"maximum", number(difference.maximum)},
          {"rms", number(difference.rms)},
          {"psnr", number(difference.psnr)},
          {"relative_l2", number(difference.relative_l2)}};
}

Json to_json(const ImageDifference& difference, const CompareOptions& options) {
  Json json = {{"image", options.image.string()}, {"reference", options.reference.string()}};
  for (int channel = 0; channel < difference.channels_compared; ++channel) {
    json[channel_name(channel)] = to_json(difference.channels[static_cast<std::size_t>(channel)]);
  }
  json["overall"] = to_json(difference.overall);
  json["worst"] = {{"measure", number(difference.worst)},
                   {"x", difference.worst_x},
                   {"y", difference.worst_y},
                   {"channel", channel_name(difference.worst_channel)}};
  json["pixels"] = difference.pixels;
  json["pixels_not_finite"] = difference.pixels_not_finite;
  if (options.limit) {
    json["limit"] = *options.limit;
    json["pixels_beyond"] = difference.pixels_beyond;
  }
  return json;
}

std::string to_line(const char* name, const ChannelDifference& difference) {
  return fmt::format("{:8} {:>12.6g} {:>12.6g} {:>9.2f} {:>12.6g}\n", name, difference.maximum,
                     difference.rms, difference.psnr, difference.relative_l2);
}

std::string to_text(const ImageDifference& difference, const CompareOptions& options) {
  std::string text = fmt::format("{:8} {:>12} {:>12} {:>9} {:>12}\n", "", "maximum", "RMS",
                                 "PSNR [dB]", "relative L2");
  for (int channel = 0; channel < difference.channels_compared; ++channel) {
    text += to_line(channel_name(channel), difference.channels[static_cast<std::size_t>(channel)]);
  }
  text += to_line("overall", difference.overall);
  if (difference.worst > 0) {
    text +=
        fmt::format("worst: {:.6g} of max(1, reference), {} of pixel {},{}\n", difference.worst,
                    channel_name(difference.worst_channel), difference.worst_x, difference.worst_y);
  } else {
    text += "the pictures are equal\n";
  }
  if (difference.pixels_not_finite > 0) {
    text += fmt::format("not finite: {} of {} pixels\n", difference.pixels_not_finite,
                        difference.pixels);
  }
  if (options.limit) {
    text += fmt::format("beyond {}: {} of {} pixels\n", *options.limit, difference.pixels_beyond,
                        difference.pixels);
  }
  return text;
}

// Display values are cut at 0 and 1, rounded, and have their scene's gamma: against light the
// numbers tell of that more than of the picture.
void note_kinds(const CompareOptions& options, bool image_is_float, bool reference_is_float,
                Console& console) {
  if (image_is_float == reference_is_float) return;
  const std::string linear = (image_is_float ? options.image : options.reference).string();
  const std::string display = (image_is_float ? options.reference : options.image).string();
  console.note(fmt::format(
      "{} holds linear floats and {} display values, which are cut at 0 and 1, rounded, and may "
      "have a gamma: the numbers tell of that, too; compare two files of one kind, such as .exr",
      linear, display));
}

ComparedChannels choose_channels(const CompareOptions& options, const ImageFileInfo& image,
                                 const ImageFileInfo& reference, Console& console) {
  const bool first = image.has_alpha, second = reference.has_alpha;
  if (first && second) return ComparedChannels::rgba;
  if (first != second) {
    console.note((first ? options.reference : options.image).string() +
                 " has no alpha, so only colours are compared");
  }
  return ComparedChannels::rgb;
}

ImageDifference measure(const CompareOptions& options, const Image& image, const Image& reference,
                        Console& console) {
  const ImageFileInfo image_info = read_image_info(options.image);
  const ImageFileInfo reference_info = read_image_info(options.reference);
  note_kinds(options, image_info.is_float, reference_info.is_float, console);
  const ComparedChannels channels = choose_channels(options, image_info, reference_info, console);
  try {
    return compare_images(image, reference, options.limit.value_or(0), channels);
  } catch (const UsageError& error) {
    throw UsageError(options.image.string() + " and " + options.reference.string() + ": " +
                     error.what());
  }
}

}  // namespace

int run_compare(const CompareOptions& options, Console& console) {
  if (options.limit && !(*options.limit >= 0)) {
    throw UsageError(fmt::format("--limit: found {}, expected a number >= 0", *options.limit));
  }
  if (options.difference) {
    check_image_path(*options.difference);
    check_outputs({{*options.difference, "--diff"}}, [&] {
      return std::set<std::filesystem::path>{options.image, options.reference};
    });
  }
  const Image image = read_image(options.image);
  const Image reference = read_image(options.reference);
  const ImageDifference difference = measure(options, image, reference, console);
  if (options.difference) {
    const double largest = difference.overall.maximum;
    const double white = std::isfinite(largest) && largest > 0 ? largest : 1;
    write_image(*options.difference, difference_image(image, reference, white));
    console.note(fmt::format("in {} grey is no difference, white {:.6g} more and black {:.6g} less",
                             options.difference->string(), white, white));
  }
  std::cout << (options.json ? json_text(to_json(difference, options))
                             : to_text(difference, options));
  return options.limit && difference.pixels_beyond > 0 ? 1 : 0;
}

}  // namespace splotchcl::cli
