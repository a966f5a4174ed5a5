#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "pictures/video/framing.hpp"
#include "pictures/video/image.hpp"

namespace twin::pictures::video {

/// The MJCF scene of the table, drawn offscreen. All calls from the thread that created it.
///
/// Functions that call MuJoCo may throw hal::mujoco::MujocoError; renderer.cpp turns it into an Error.
class TableScene {
 public:
  /// Loads the scene and prepares pictures of a size.
  ///
  /// @param scene_xml  MJCF file with the joints, the texture and the camera named in
  /// hal/mujoco/table_pose.hpp
  /// @param camera     name of a camera of the scene
  /// @param samples    0: hard edges and quick; 4: smooth edges at twice the time
  static Expected<TableScene> create(const std::filesystem::path& scene_xml,
                                     const std::string& camera, int width, int height, int samples);
  TableScene(TableScene&&) noexcept;
  TableScene& operator=(TableScene&&) noexcept;
  ~TableScene();

  Lens lens() const;  ///< of the camera

  /// Stands the camera somewhere else, its direction unchanged; seen after the next move_to().
  /// @param place  [m]
  void stand_camera_at(const Vec3& place);

  /// Moves the table. @param position  of the pen on the plate x, y and its height z [mm]
  void move_to(const Vec3& position);

  /// Puts the part of a picture that changed onto the plate. @param drawing  of the texture's size
  void set_drawing(const Image& drawing, const Rectangle& changed);

  /// Draws the scene. @param frame  picture of the size given at creation
  void render(Image& frame);

  /// Draws one character of MuJoCo's large font, white on black, into a picture of
  /// character_width(character) by character_height() pixels.
  Image render_character(char character);
  int character_width(char character) const;
  int character_height() const;

 private:
  struct Parts;
  explicit TableScene(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace twin::pictures::video
