// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/vector_files.hpp"

#include <algorithm>
#include <cctype>
#include <memory>
#include <utility>

#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include "tools/survey/files/gdal_support.hpp"

namespace adit {
namespace {

using VectorFile = std::unique_ptr<GDALDataset, CloseDataset>;

struct DestroyFeature {
  void operator()(OGRFeature* feature) const { OGRFeature::DestroyFeature(feature); }
};
using Feature = std::unique_ptr<OGRFeature, DestroyFeature>;

VectorFile create(const char* driver_name, const std::filesystem::path& path) {
  prepare_gdal();
  CPLErrorReset();
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(driver_name);
  if (driver == nullptr) fail_gdal(path);
  VectorFile file(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!file) fail_gdal(path);
  return file;
}

void finish(VectorFile file, const std::filesystem::path& path) {
  file->FlushCache(true);
  file.reset();
  if (CPLGetLastErrorType() >= CE_Failure) fail_gdal(path);
}

OGRFieldType type_of(VectorLayer::Field::Type type) {
  switch (type) {
    case VectorLayer::Field::Type::kInteger:
      return OFTInteger64;
    case VectorLayer::Field::Type::kNumber:
      return OFTReal;
    case VectorLayer::Field::Type::kText:
      return OFTString;
  }
  return OFTString;
}

std::unique_ptr<OGRGeometry> geometry_of(const VectorFeature& feature,
                                         VectorLayer::Geometry geometry) {
  if (geometry == VectorLayer::Geometry::kPoint) {
    const Eigen::Vector3d& p = feature.points.front();
    return std::make_unique<OGRPoint>(p.x(), p.y(), p.z());
  }
  auto line = std::make_unique<OGRLineString>();
  for (const Eigen::Vector3d& p : feature.points) line->addPoint(p.x(), p.y(), p.z());
  return line;
}

void set_value(int field, const AttributeValue& value, OGRFeature& feature) {
  if (const auto* const integer = std::get_if<std::int64_t>(&value))
    feature.SetField(field, static_cast<GIntBig>(*integer));
  if (const auto* const number = std::get_if<double>(&value)) feature.SetField(field, *number);
  if (const auto* const text = std::get_if<std::string>(&value))
    feature.SetField(field, text->c_str());
}

void add_table(const VectorLayer& layer, OGRSpatialReference& crs, GDALDataset& file,
               const std::filesystem::path& path) {
  const bool points = layer.geometry == VectorLayer::Geometry::kPoint;
  OGRLayer* const table =
      file.CreateLayer(layer.name.c_str(), &crs, points ? wkbPoint25D : wkbLineString25D, nullptr);
  if (table == nullptr) fail_gdal(path);
  for (const VectorLayer::Field& field : layer.fields) {
    OGRFieldDefn definition(field.name.c_str(), type_of(field.type));
    if (table->CreateField(&definition) != OGRERR_NONE) fail_gdal(path);
  }
  for (const VectorFeature& feature : layer.features) {
    const Feature row(OGRFeature::CreateFeature(table->GetLayerDefn()));
    row->SetGeometryDirectly(geometry_of(feature, layer.geometry).release());
    for (std::size_t i = 0; i < feature.values.size(); ++i)
      set_value(static_cast<int>(i), feature.values[i], *row);
    if (table->CreateFeature(row.get()) != OGRERR_NONE) fail_gdal(path);
  }
}

std::string drawing_name(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

/// Colours that drawings use on white and on black.
const char* colour_of(const std::string& drawing_layer) {
  if (drawing_layer.starts_with("HAZARDS")) return "#d02020";
  if (drawing_layer.starts_with("FRONTIERS")) return "#c07000";
  if (drawing_layer.starts_with("CENTRE_LINES")) return "#2060c0";
  if (drawing_layer.starts_with("FLOOR_CONTOURS")) return "#808080";
  if (drawing_layer.starts_with("PATH")) return "#20a060";
  if (drawing_layer.starts_with("WATER")) return "#2090d0";
  return "#000000";
}

void add_entity(const std::string& drawing_layer, std::unique_ptr<OGRGeometry> geometry,
                const std::string& style, OGRLayer& entities, const std::filesystem::path& path) {
  const Feature entity(OGRFeature::CreateFeature(entities.GetLayerDefn()));
  entity->SetField("Layer", drawing_layer.c_str());
  entity->SetGeometryDirectly(geometry.release());
  entity->SetStyleString(style.c_str());
  if (entities.CreateFeature(entity.get()) != OGRERR_NONE) fail_gdal(path);
}

/// The text without what ends a style string.
std::string style_text(std::string text) {
  std::erase_if(text, [](char c) { return c == '"' || c == '\\' || c == '\n'; });
  return text;
}

}  // namespace

void write_geopackage(const std::vector<VectorLayer>& layers, const std::string& crs_wkt,
                      const std::filesystem::path& path) {
  VectorFile file = create("GPKG", path);
  OGRSpatialReference crs;
  if (crs.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE) fail_gdal(path);
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (file->StartTransaction() != OGRERR_NONE) fail_gdal(path);
  for (const VectorLayer& layer : layers) add_table(layer, crs, *file, path);
  if (file->CommitTransaction() != OGRERR_NONE) fail_gdal(path);
  finish(std::move(file), path);
}

void write_dxf(const std::vector<VectorLayer>& layers, const std::filesystem::path& path) {
  VectorFile file = create("DXF", path);
  OGRLayer* const entities = file->CreateLayer("entities", nullptr, wkbUnknown, nullptr);
  if (entities == nullptr) fail_gdal(path);
  for (const VectorLayer& layer : layers) {
    const std::string name = drawing_name(layer.name);
    const std::string colour = colour_of(name);
    const std::string pen = "PEN(c:" + colour + ")";
    for (const VectorFeature& feature : layer.features) {
      add_entity(name, geometry_of(feature, layer.geometry), pen, *entities, path);
      if (feature.label.empty()) continue;
      const Eigen::Vector3d& p = feature.points[feature.points.size() / 2];
      add_entity(
          name + "_TEXT", std::make_unique<OGRPoint>(p.x(), p.y(), p.z()),
          "LABEL(f:\"Arial\",t:\"" + style_text(feature.label) + "\",s:0.5g,c:" + colour + ")",
          *entities, path);
    }
  }
  finish(std::move(file), path);
}

}  // namespace adit
