#include "pictures/video/table_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "hal/mujoco/model.hpp"
#include "hal/mujoco/mujoco_library.hpp"
#include "hal/mujoco/table_pose.hpp"
#include "pictures/video/mip_texture.hpp"
#include "pictures/video/offscreen_context.hpp"

namespace twin::pictures::video {
namespace {

/// mjvScene that frees itself.
struct Scene : mjvScene {
  explicit Scene(const mjModel& model) {
    constexpr int most_geoms = 2000;
    mjv_defaultScene(this);
    mjv_makeScene(&model, this, most_geoms);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() { mjv_freeScene(this); }
};

/// mjrContext that frees itself; an OpenGL context must be current.
struct Renderer : mjrContext {
  explicit Renderer(const mjModel& model) {
    mjr_defaultContext(this);
    mjr_makeContext(&model, this, mjFONTSCALE_300);
    mjr_setBuffer(mjFB_OFFSCREEN, this);
  }
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  ~Renderer() { mjr_freeContext(this); }
};

/// Pixels below the base line that letters such as g need.
int descent(const mjrContext& renderer) { return renderer.charHeight / 4; }

/// What a frame costs is decided here; reflections and shadows, each of which would cost as much
/// again, are off as well.
void set_quality(mjModel& model, int width, int height, int samples) {
  model.vis.global.offwidth = width;
  model.vis.global.offheight = height;
  model.vis.quality.offsamples = samples;
  model.vis.quality.shadowsize = 0;
  model.vis.quality.numslices = std::min(model.vis.quality.numslices, 16);
  model.vis.quality.numstacks = std::min(model.vis.quality.numstacks, 8);
  model.vis.quality.numquads = std::min(model.vis.quality.numquads, 2);
}

/// The drawing is seen through the pen, which is wider than most of its details.
void make_pen_transparent(mjModel& model) {
  const int material = mj_name2id(&model, mjOBJ_MATERIAL, "pen");
  if (material >= 0) {
    model.mat_rgba[4 * material + 3] = 0.35F;
  }
}

/// What lies high is drawn first: every camera looks down, so that what it hides is not shaded.
void draw_upper_first(mjvScene& scene) {
  std::stable_sort(scene.geoms, scene.geoms + scene.ngeom,
                   [](const mjvGeom& a, const mjvGeom& b) { return a.pos[2] > b.pos[2]; });
}

}  // namespace

struct TableScene::Parts {
  Parts(OffscreenContext&& gl_context, hal::mujoco::ModelPtr&& loaded, hal::mujoco::DataPtr&& state,
        int texture_id)
      : context(std::move(gl_context)),
        model(std::move(loaded)),
        data(std::move(state)),
        scene(*model),
        renderer(*model),
        texture(renderer.texture[texture_id]),
        viewport(mjr_maxViewport(&renderer)) {
    mjv_defaultCamera(&camera);
    mjv_defaultOption(&option);
    scene.flags[mjRND_REFLECTION] = 0;
    scene.flags[mjRND_SHADOW] = 0;
  }

  /// Reads a part of the frame that was drawn last, lower left corner first, into a picture of its
  /// size.
  void read(const mjrRect& part, Image& picture) {
    const std::size_t stride = 3UL * static_cast<std::size_t>(part.width);
    pixels.resize(stride * static_cast<std::size_t>(part.height));
    mjr_readPixels(pixels.data(), nullptr, part, &renderer);
    for (int y = 0; y < part.height; ++y) {
      const auto from = static_cast<std::size_t>(part.height - 1 - y);
      std::memcpy(picture.row(y), pixels.data() + from * stride, stride);
    }
  }

  OffscreenContext context;  // outlives the renderer
  hal::mujoco::ModelPtr model;
  hal::mujoco::DataPtr data;
  Scene scene;
  Renderer renderer;
  mjvCamera camera{};
  mjvOption option{};
  hal::mujoco::TablePose pose;
  MipTexture texture;
  mjrRect viewport;
  std::vector<unsigned char> pixels;  // as OpenGL has them, lowest row first
};

TableScene::TableScene(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
TableScene::TableScene(TableScene&&) noexcept = default;
TableScene& TableScene::operator=(TableScene&&) noexcept = default;
TableScene::~TableScene() = default;

Expected<TableScene> TableScene::create(const std::filesystem::path& scene_xml,
                                        const std::string& camera, int width, int height,
                                        int samples) {
  auto model = hal::mujoco::load_model(scene_xml);
  if (!model) {
    return tl::unexpected(std::move(model.error()));
  }
  const auto pose = hal::mujoco::find_table_pose(**model);
  const auto texture =
      hal::mujoco::find_id(**model, mjOBJ_TEXTURE, "texture", hal::mujoco::kDrawingTexture);
  const auto camera_id = hal::mujoco::find_id(**model, mjOBJ_CAMERA, "camera", camera);
  for (const Error* error : {pose ? nullptr : &pose.error(), texture ? nullptr : &texture.error(),
                             camera_id ? nullptr : &camera_id.error()}) {
    if (error != nullptr) {
      Error located = *error;
      located.file = scene_xml.string();
      return tl::unexpected(std::move(located));
    }
  }
  set_quality(**model, width, height, samples);
  make_pen_transparent(**model);
  auto data = hal::mujoco::make_data(**model);
  if (!data) {
    return tl::unexpected(std::move(data.error()));
  }
  auto context = OffscreenContext::create();
  if (!context) {
    return tl::unexpected(std::move(context.error()));
  }
  auto parts =
      std::make_unique<Parts>(std::move(*context), std::move(*model), std::move(*data), *texture);
  parts->pose = *pose;
  parts->camera.type = mjCAMERA_FIXED;
  parts->camera.fixedcamid = *camera_id;
  return TableScene(std::move(parts));
}

Lens TableScene::lens() const {
  const mjModel& model = *parts_->model;
  const int id = parts_->camera.fixedcamid;
  mj_forward(&model, parts_->data.get());
  const mjtNum* const axes = parts_->data->cam_xmat + 9 * id;  // right, up and back are columns
  Lens lens;
  lens.right = {axes[0], axes[3], axes[6]};
  lens.up = {axes[1], axes[4], axes[7]};
  lens.tangent.y() = std::tan(model.cam_fovy[id] * std::numbers::pi / 360.0);
  lens.tangent.x() = lens.tangent.y() * parts_->viewport.width / parts_->viewport.height;
  return lens;
}

void TableScene::stand_camera_at(const Vec3& place) {
  Vec3::Map(parts_->model->cam_pos + 3 * parts_->camera.fixedcamid) = place;
}

void TableScene::move_to(const Vec3& position) {
  hal::mujoco::set_table_pose(parts_->pose, *parts_->data, position.x(), position.y(),
                              position.z());
  mj_forward(parts_->model.get(), parts_->data.get());
}

void TableScene::set_drawing(const Image& drawing, const Rectangle& changed) {
  MipTexture& texture = parts_->texture;
  if (drawing.width() != texture.width() || drawing.height() != texture.height()) {
    throw hal::mujoco::MujocoError(fmt::format(
        "texture {} has {} x {} texels, the drawing {} x {}", hal::mujoco::kDrawingTexture,
        texture.width(), texture.height(), drawing.width(), drawing.height()));
  }
  texture.update(drawing, changed);
}

void TableScene::render(Image& frame) {
  Parts& p = *parts_;
  mjv_updateScene(p.model.get(), p.data.get(), &p.option, nullptr, &p.camera, mjCAT_ALL, &p.scene);
  draw_upper_first(p.scene);
  mjr_render(p.viewport, &p.scene, &p.renderer);
  p.read(p.viewport, frame);
}

Image TableScene::render_character(char character) {
  Parts& p = *parts_;
  Image result(character_width(character), character_height());
  mjr_rectangle(p.viewport, 0.0F, 0.0F, 0.0F, 1.0F);
  const float base_line =
      static_cast<float>(descent(p.renderer)) / static_cast<float>(p.viewport.height);
  mjr_text(mjFONT_NORMAL, std::string(1, character).c_str(), &p.renderer, 0.0F, base_line, 1.0F,
           1.0F, 1.0F);
  p.read({0, 0, result.width(), result.height()}, result);
  return result;
}

int TableScene::character_width(char character) const {
  return std::min<int>(parts_->renderer.charWidth[static_cast<unsigned char>(character)],
                       parts_->viewport.width);
}

int TableScene::character_height() const {
  return std::min(parts_->renderer.charHeight + descent(parts_->renderer), parts_->viewport.height);
}

}  // namespace twin::pictures::video
