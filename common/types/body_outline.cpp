// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/types/body_outline.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr double kToleranceM = 0.001;

void check_symmetry(const ConvexPolygon& outline) {
  for (const Eigen::Vector2d& corner : outline.corners()) {
    for (const Eigen::Vector2d& sign : {Eigen::Vector2d(1.0, -1.0), Eigen::Vector2d(-1.0, 1.0)}) {
      const Eigen::Vector2d image = corner.cwiseProduct(sign);
      const bool has_image = std::ranges::any_of(
          outline.corners(),
          [&](const Eigen::Vector2d& other) { return (other - image).norm() <= kToleranceM; });
      if (has_image) continue;
      throw std::invalid_argument(fmt::format(
          "vehicle.footprint: corner ({}, {}) m has no image at ({}, {}): the footprint "
          "must be symmetric about both axes of the body; take a symmetric one that "
          "encloses the vehicle",
          corner.x(), corner.y(), image.x(), image.y()));
    }
  }
}

void check_size(const ConvexPolygon& outline, const Vehicle& vehicle) {
  const Eigen::Vector2d size = outline.high() - outline.low();
  const Eigen::Vector2d stated(vehicle.length_m, vehicle.width_m);
  if ((size - stated).cwiseAbs().maxCoeff() <= kToleranceM) return;
  throw std::invalid_argument(
      fmt::format("vehicle.footprint is {:.3f} m long and {:.3f} m wide, but vehicle.length_m and "
                  "vehicle.width_m are {} and {}",
                  size.x(), size.y(), stated.x(), stated.y()));
}

}  // namespace

ConvexPolygon body_outline(const Vehicle& vehicle) {
  if (vehicle.footprint.empty())
    return ConvexPolygon::rectangle({0.0, 0.0}, {vehicle.length_m / 2.0, vehicle.width_m / 2.0});
  std::vector<Eigen::Vector2d> corners;
  for (const FootprintCorner& corner : vehicle.footprint)
    corners.emplace_back(corner.x_m, corner.y_m);
  ConvexPolygon outline(corners);
  if (outline.empty())
    throw std::invalid_argument(
        "vehicle.footprint: the corners lie on one line, or are fewer than 3");
  check_symmetry(outline);
  check_size(outline, vehicle);
  return outline;
}

Vehicle with_outline_grown(Vehicle vehicle, double by_m) {
  const ConvexPolygon outline = body_outline(vehicle).grown(by_m);
  if (!vehicle.footprint.empty()) {
    vehicle.footprint.clear();
    for (const Eigen::Vector2d& corner : outline.corners())
      vehicle.footprint.push_back({corner.x(), corner.y()});
  }
  vehicle.length_m = outline.high().x() - outline.low().x();
  vehicle.width_m = outline.high().y() - outline.low().y();
  return vehicle;
}

}  // namespace adit
