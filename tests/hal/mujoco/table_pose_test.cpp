#include "hal/mujoco/table_pose.hpp"

#include <gtest/gtest.h>

#include "hal/mujoco/model.hpp"
#include "tests/support/table_files.hpp"

namespace twin::hal::mujoco {
namespace table_pose_test {

class Scene : public ::testing::Test {
 protected:
  void SetUp() override {
    auto loaded = load_model(test::mjcf_file("scene.xml"));
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    model = std::move(*loaded);
    auto made = make_data(*model);
    ASSERT_TRUE(made);
    data = std::move(*made);
    auto found = find_table_pose(*model);
    ASSERT_TRUE(found);
    pose = *found;
  }
  int id(mjtObj type, const char* name) const { return mj_name2id(model.get(), type, name); }

  ModelPtr model;
  DataPtr data;
  TablePose pose;
};

TEST_F(Scene, HasTheNamesThatRenderingUses) {
  EXPECT_GE(id(mjOBJ_CAMERA, kCameraIso), 0);
  EXPECT_GE(id(mjOBJ_CAMERA, kCameraTop), 0);
  EXPECT_GE(id(mjOBJ_SITE, kPenSite), 0);
  EXPECT_GE(id(mjOBJ_BODY, kPlateBody), 0);
  EXPECT_GE(id(mjOBJ_GEOM, kPlateGeom), 0);
  const int texture = id(mjOBJ_TEXTURE, kDrawingTexture);
  ASSERT_GE(texture, 0);
  EXPECT_EQ(model->tex_width[texture], kDrawingTexels);
  EXPECT_EQ(model->tex_height[texture], kDrawingTexels);
  EXPECT_EQ(model->vis.global.offwidth, 1280);
  EXPECT_EQ(model->vis.global.offheight, 720);
}

TEST_F(Scene, PenStandsAtTheCommandedPlaceOnThePlate) {
  const int site = id(mjOBJ_SITE, kPenSite);
  const int body = id(mjOBJ_BODY, kPlateBody);
  for (const auto& [x, y, z] : {std::array{0.0, 0.0, 0.0}, std::array{150.0, -37.0, 20.0},
                                std::array{-200.0, 200.0, 60.0}}) {
    set_table_pose(pose, *data, x, y, z);
    mj_kinematics(model.get(), data.get());
    EXPECT_NEAR(1e3 * (data->site_xpos[3 * site] - data->xpos[3 * body]), x, 1e-9);
    EXPECT_NEAR(1e3 * (data->site_xpos[3 * site + 1] - data->xpos[3 * body + 1]), y, 1e-9);
  }
}

TEST_F(Scene, PenTouchesTheTopOfThePlateAtZeroHeight) {
  mj_kinematics(model.get(), data.get());
  const int geom = id(mjOBJ_GEOM, kPlateGeom);
  const double top = data->geom_xpos[3 * geom + 2] + model->geom_size[3 * geom + 2];
  EXPECT_NEAR(data->site_xpos[3 * id(mjOBJ_SITE, kPenSite) + 2], top, 1e-9);
}

TEST_F(Scene, DrawingCoversThePlateTopAndTheWholeTravel) {
  const int geom = id(mjOBJ_GEOM, kPlateGeom);
  EXPECT_NEAR(model->geom_size[3 * geom] * 1e3, kDrawingHalfSide, 1e-9);
  EXPECT_NEAR(model->geom_size[3 * geom + 1] * 1e3, kDrawingHalfSide, 1e-9);
  EXPECT_GE(kDrawingHalfSide, 200.0);
  EXPECT_NEAR(drawing_column(-kDrawingHalfSide), 0.0, 1e-9);
  EXPECT_NEAR(drawing_column(kDrawingHalfSide), kDrawingTexels, 1e-9);
  EXPECT_NEAR(drawing_row(kDrawingHalfSide), 0.0, 1e-9);
}

}  // namespace table_pose_test
}  // namespace twin::hal::mujoco
