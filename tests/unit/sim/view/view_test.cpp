// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/view.hpp"

#include <stdexcept>
#include <string>

#include <cairo.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

class View : public testing::Test {
 protected:
  std::string drawn(const Site& site, ViewOptions options = {}) const {
    options.width_px = 600;  // quick
    write_view(site, png_, options);
    return test::contents(png_);
  }
  int width() const {
    cairo_surface_t* image = cairo_image_surface_create_from_png(png_.c_str());
    const int width = cairo_image_surface_get_width(image);
    cairo_surface_destroy(image);
    return width;
  }

 private:
  test::ScratchFolder folder_;
  std::filesystem::path png_ = folder_ / "view.png";
};

TEST_F(View, SameMineGivesTheSameBytes) {
  const Site site(box_tunnel());
  const Site again(box_tunnel());
  EXPECT_EQ(drawn(site), drawn(again));
  EXPECT_EQ(width(), 600);
}

TEST_F(View, DependsOnThePoseOfTheCamera) {
  const Site site(box_tunnel());
  ViewOptions options;
  options.from = Pose2{5.0, 0.0, 1.0};
  EXPECT_NE(drawn(site), drawn(site, options));
}

TEST_F(View, DrawsAMineWithATunnelGraph) {
  World world = box_tunnel();
  world.truth.tunnels = {{{{-20.0, 0.0}, false}, {{20.0, 0.0}, false}},
                         {{0, 1, {{-20.0, 0.0}, {20.0, 0.0}}, 40.0, 4.0, "main"}}};
  const Site with(std::move(world));
  const Site without(box_tunnel());
  EXPECT_NE(drawn(with), drawn(without));  // a title, and another line to cut along
}

TEST_F(View, DrawsAnEmptyWorld) {
  const Site site(World{});
  EXPECT_FALSE(drawn(site).empty());
}

TEST_F(View, ReportsAWriteError) {
  const Site site(World{});
  EXPECT_THROW(write_view(site, "/nonexistent/view.png"), std::runtime_error);
}

}  // namespace
}  // namespace adit
