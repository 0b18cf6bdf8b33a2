// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/given_lines.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include "common/text/message_text.hpp"
#include "tools/survey/files/gdal_support.hpp"

namespace adit {
namespace {

struct DestroyTransformation {
  void operator()(OGRCoordinateTransformation* transformation) const {
    OGRCoordinateTransformation::DestroyCT(transformation);
  }
};
using Transformation = std::unique_ptr<OGRCoordinateTransformation, DestroyTransformation>;

[[noreturn]] void reject(const std::filesystem::path& path, const std::string& why) {
  throw std::runtime_error(message_line(fmt::format("{}: {}", path.string(), why)));
}

/// From the system of a layer into the grid; empty where they are the same, or the layer has none.
Transformation transformation_of(OGRLayer& layer, const std::string& crs_wkt,
                                 const std::filesystem::path& path) {
  const OGRSpatialReference* const given = layer.GetSpatialRef();
  if (given == nullptr || given->IsLocal()) return {};
  OGRSpatialReference grid;
  if (grid.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE || grid.IsLocal()) {
    reject(path, fmt::format("layer {} is in {}, the survey in a grid that nothing ties to it: "
                             "give control points with --crs EPSG:n, or the lines without a "
                             "coordinate system",
                             quote(layer.GetName()), given->GetName()));
  }
  OGRSpatialReference from(*given);
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  grid.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (from.IsSame(&grid) != 0) return {};
  Transformation transformation(OGRCreateCoordinateTransformation(&from, &grid));
  if (!transformation)
    reject(path,
           fmt::format("cannot be transformed from {} into {}", given->GetName(), grid.GetName()));
  return transformation;
}

std::string name_of(const OGRFeature& feature) {
  for (const char* field : {"name", "label", "Text", "id", "Layer"}) {
    const int i = feature.GetFieldIndex(field);  // without regard to case
    if (i < 0 || feature.IsFieldSetAndNotNull(i) == 0) continue;
    if (std::string text = feature.GetFieldAsString(i); !text.empty()) return text;
  }
  return std::to_string(feature.GetFID());
}

class GivenLineCollector {
 public:
  GivenLineCollector(std::filesystem::path path, std::vector<GivenLine>& lines)
      : path_(std::move(path)), lines_(lines) {}

  void add(const OGRGeometry& geometry, const std::string& layer, const std::string& name) {
    switch (wkbFlatten(geometry.getGeometryType())) {
      case wkbPoint:
        add_points({{geometry.toPoint()->getX(), geometry.toPoint()->getY()}}, false, layer, name);
        return;
      case wkbLineString:
        add_line(*geometry.toLineString(), false, layer, name);
        return;
      case wkbPolygon:
        for (const OGRLinearRing* ring : *geometry.toPolygon()) add_line(*ring, true, layer, name);
        return;
      default:
        break;
    }
    if (OGR_GT_IsNonLinear(geometry.getGeometryType()) != 0) {
      const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
      if (linear) add(*linear, layer, name);
    } else if (OGR_GT_IsSubClassOf(wkbFlatten(geometry.getGeometryType()), wkbGeometryCollection) !=
               0) {
      for (const OGRGeometry* part : *geometry.toGeometryCollection()) add(*part, layer, name);
    } else {
      reject(path_, fmt::format("layer {} has geometries of type {}, not points, lines or areas",
                                quote(layer), geometry.getGeometryName()));
    }
  }

 private:
  void add_line(const OGRLineString& line, bool is_area, const std::string& layer,
                const std::string& name) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < line.getNumPoints(); ++i) points.emplace_back(line.getX(i), line.getY(i));
    add_points(std::move(points), is_area || (line.getNumPoints() > 3 && line.get_IsClosed() != 0),
               layer, name);
  }
  void add_points(std::vector<Eigen::Vector2d> points, bool is_area, const std::string& layer,
                  const std::string& name) {
    if (points.empty()) return;
    for (const Eigen::Vector2d& p : points) {
      if (!p.allFinite()) reject(path_, fmt::format("{} has coordinates that are none", name));
    }
    lines_.push_back({layer, name, std::move(points), is_area});
  }

  std::filesystem::path path_;
  std::vector<GivenLine>& lines_;
};

}  // namespace

std::vector<GivenLine> read_given_lines(const std::filesystem::path& path,
                                        const std::string& crs_wkt) {
  prepare_gdal();
  CPLErrorReset();
  const std::unique_ptr<GDALDataset, CloseDataset> file(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!file) {
    const std::string reason = CPLGetLastErrorMsg();
    reject(path, reason.empty() ? "not a vector file that GDAL reads" : reason);
  }
  std::vector<GivenLine> lines;
  GivenLineCollector collector(path, lines);
  for (OGRLayer* layer : file->GetLayers()) {
    const Transformation into_grid = transformation_of(*layer, crs_wkt, path);
    for (const auto& feature : *layer) {
      OGRGeometry* const geometry = feature->GetGeometryRef();
      if (geometry == nullptr || geometry->IsEmpty() != 0) continue;
      if (into_grid && geometry->transform(into_grid.get()) != OGRERR_NONE)
        reject(path, fmt::format("{} lies outside of the coordinate system of the survey",
                                 name_of(*feature)));
      collector.add(*geometry, layer->GetName(), name_of(*feature));
    }
  }
  if (lines.empty()) reject(path, "no point, line or area in it");
  return lines;
}

}  // namespace adit
