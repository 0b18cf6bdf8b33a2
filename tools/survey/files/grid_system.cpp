// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/grid_system.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>
#include <proj.h>

#include "common/geometry/local_crs.hpp"
#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"
#include "tools/survey/files/gdal_support.hpp"

namespace adit {
namespace {

struct DestroyProjection {
  void operator()(PJ* projection) const { proj_destroy(projection); }
};
struct DestroyContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using Context = std::unique_ptr<PJ_CONTEXT, DestroyContext>;
using Projection = std::unique_ptr<PJ, DestroyProjection>;

std::string wkt_of(const OGRSpatialReference& crs) {
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  crs.exportToWkt(&text, options);
  std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  return wkt;
}

/// Whether a place is where the system may be used.
bool is_in_area(const OGRSpatialReference& crs, double longitude_deg, double latitude_deg) {
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;
  if (!crs.GetAreaOfUse(&west, &south, &east, &north, nullptr)) return true;
  const bool over_date_line = west > east;
  const bool in_longitude = over_date_line ? longitude_deg >= west || longitude_deg <= east
                                           : longitude_deg >= west && longitude_deg <= east;
  return in_longitude && latitude_deg >= south && latitude_deg <= north;
}

}  // namespace

GridSystem grid_system(const std::string& crs) {
  if (crs == "local") {
    const std::string wkt = local_crs_wkt("mine grid", "control points of the survey");
    return {wkt, "mine grid", wkt, false};
  }
  prepare_gdal();
  OGRSpatialReference found;
  if (!crs.starts_with("EPSG:") || found.SetFromUserInput(crs.c_str()) != OGRERR_NONE)
    throw std::runtime_error(
        fmt::format("no coordinate system {}: give EPSG:n, or local", quote(crs)));
  const std::string name = found.GetName() == nullptr ? crs : found.GetName();
  if (found.IsGeographic()) {
    throw std::runtime_error(fmt::format(
        "{} ({}) has degrees: give the projected system of the eastings and northings", crs, name));
  }
  if (!found.IsProjected())
    throw std::runtime_error(fmt::format("{} ({}) has no eastings and northings", crs, name));
  const char* unit = nullptr;
  if (std::abs(found.GetLinearUnits(&unit) - 1.0) > 1e-9) {
    throw std::runtime_error(fmt::format("{} ({}) counts in {}, not in metres", crs, name,
                                         unit == nullptr ? "another unit" : unit));
  }
  return {wkt_of(found), name, "urn:ogc:def:crs:EPSG::" + crs.substr(5), true};
}

std::optional<GridFactors> grid_factors(const GridSystem& grid, const Eigen::Vector2d& p_grid) {
  if (!grid.is_projected) return std::nullopt;
  const Context context(proj_context_create());
  const Projection crs(proj_create(context.get(), grid.wkt.c_str()));
  const Projection geodetic(crs ? proj_crs_get_geodetic_crs(context.get(), crs.get()) : nullptr);
  if (!crs || !geodetic) return std::nullopt;
  const Projection raw(
      proj_create_crs_to_crs_from_pj(context.get(), crs.get(), geodetic.get(), nullptr, nullptr));
  const Projection to_geodetic(raw ? proj_normalize_for_visualization(context.get(), raw.get())
                                   : nullptr);
  if (!to_geodetic) return std::nullopt;
  const PJ_COORD place =
      proj_trans(to_geodetic.get(), PJ_FWD, proj_coord(p_grid.x(), p_grid.y(), 0.0, 0.0));
  if (!std::isfinite(place.lp.lam) || !std::isfinite(place.lp.phi)) return std::nullopt;
  const PJ_FACTORS factors = proj_factors(
      crs.get(), proj_coord(deg_to_rad(place.lp.lam), deg_to_rad(place.lp.phi), 0.0, 0.0));
  OGRSpatialReference reference;
  reference.importFromWkt(grid.wkt.c_str());
  return GridFactors{factors.meridional_scale, factors.meridian_convergence, place.lp.lam,
                     place.lp.phi, is_in_area(reference, place.lp.lam, place.lp.phi)};
}

}  // namespace adit
