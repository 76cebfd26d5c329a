#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/finish.h"
#include "splotchcl/image_file.h"
#include "splotchcl/picture.h"
#include "splotchcl/renderer.h"
#include "splotchcl/tree_use.h"

namespace splotchcl {

class OtherScenes;

// What a picture took that was drawn from a tree; all 0 where none was.
struct TreeStats {
  std::uint64_t nodes = 0, particles = 0;  // drawn
  std::uint64_t visited = 0;               // nodes that were looked at
  std::uint64_t bytes = 0;                 // of the tree, for these
  double estimate = 0;                     // of what nodes err by, over what is promised
  int cuts = 0;                            // that were drawn until one served
  int verified_blocks = 0;
  double found = 0;  // the largest error there, over what is promised: an estimate
};

// What draws, and whom to tell how far it is.
struct FrameDrawerOptions {
  std::string device;         // part of its name, as in RendererOptions
  bool by_reference = false;  // the oracle draws, in double precision and slowly; no device does
  // Called with what is being done and the fraction done, where it takes long. May be empty.
  std::function<void(const std::string& what, double fraction)> progress;
  bool certify = false;  // as in RendererOptions
  CompositeShape shape = CompositeShape::automatic;
  bool columns_stay = false;       // as in RendererOptions: not for arrays that change in place
  std::uint64_t memory_bytes = 0;  // as in RendererOptions
  // As in RendererOptions. All ranks draw the same scenes and have the same pictures.
  std::shared_ptr<Communicator> ranks = nullptr;
  StartCompiler start_compiler = {};  // as in RendererOptions
  // The device is opened while the caller goes on. What is wrong with it is thrown by the first
  // draw(), not by the constructor. Not with ranks.
  bool opens_later = false;
  TreeUse tree = TreeUse::automatic;
  PictureLight light = PictureLight::shown;  // which the pictures hold
};

// One frame of a scene, drawn, and what is to be told of it.
struct DrawnFrame {
  std::vector<Picture> pictures;
  // The scene's, with the exposure and the white that the pictures decided where the scene leaves
  // them open. Nothing where no light was drawn that could decide.
  std::optional<FinishSettings> finish;
  // Of all drawings together that the pictures are made of (eyes, faces, insets): seconds add up,
  // and what is counted is the largest, since they share their particles.
  RenderStats stats;
  TreeStats tree;
  std::vector<std::string> notes;  // what the user should know, a line each
  // One such line about particles that were left out for their bad values, if there were some.
  std::optional<std::string> bad_particles;

  // Both of them.
  std::vector<std::string> all_notes() const;
};

// Draws the frames of scenes, on a device or with the oracle, always in the same way: loads what
// the scene uses, draws its views, finishes the pictures, and keeps account of what is to be
// told. Everything that draws but maps does so through this class. Keeps compiled kernels and
// buffers between frames. Several threads may draw, each its own scenes and frames, and without
// ranks, as Renderer says.
class FrameDrawer {
 public:
  // Throws DeviceError where there is no device, UsageError where none has such a name.
  explicit FrameDrawer(const FrameDrawerOptions& options = {});
  ~FrameDrawer();
  FrameDrawer(FrameDrawer&&) noexcept;
  FrameDrawer& operator=(FrameDrawer&&) noexcept;

  // Of a device that opens later: throws what was wrong with it, if that is known by now.
  void check_device() const;

  // Which light pictures hold from now on.
  void keep(PictureLight light);

  // Throws as load_frame and Renderer::render do.
  DrawnFrame draw(const Scene& scene, const Snapshot& snapshot);
  // For the frames of a film, which keep what other scenes they fade to. With moments, which have
  // the same views, the light is the mean of theirs.
  DrawnFrame draw(const Scene& scene, const Snapshot& snapshot, OtherScenes& other_scenes,
                  const std::vector<Moment>& moments = {});
  // What the scene's finish leaves open, of this frame; from rough light where a tree of merged
  // particles may serve. None of a black picture.
  std::optional<FinishSettings> find_finish(const Scene& scene, const Snapshot& snapshot,
                                            OtherScenes& other_scenes);
  // For a frame of the scene that has been loaded already, with any crop.
  DrawnFrame draw(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot);
  // For one of a film, with what is known to be told of it.
  DrawnFrame draw(const Scene& scene, const Frame& frame, const SnapshotInfo& snapshot,
                  OtherScenes& other_scenes, std::vector<std::string> notes,
                  const std::vector<Moment>& moments = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// How the pictures of a scene are stored: with its gamma, bits and dither, and with 8 bits as the
// original program makes them where it has the original's convention. The program's version is
// added to the metadata, and the exposure and the white where the scene has them.
ImageFileOptions image_file_options(const Scene& scene,
                                    std::map<std::string, std::string> metadata = {});

// What a file of this name keeps: floats hold light as it has been drawn. TIFF may hold either.
PictureLight light_of_file(const std::filesystem::path& output);

// Each picture to its own file: picture_path(output, its suffix). Files of floats take a picture's
// light as drawn, if it has that, and their headers say which it is. Throws as write_image does.
void write_pictures(const std::filesystem::path& output, const std::vector<Picture>& pictures,
                    const ImageFileOptions& options);

}  // namespace splotchcl
