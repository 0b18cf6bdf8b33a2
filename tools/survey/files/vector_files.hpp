// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/survey/files/vector_layer.hpp"

namespace adit {

/// Writes all layers as tables of a GeoPackage. Throws FileError.
void write_geopackage(const std::vector<VectorLayer>& layers, const std::string& crs_wkt,
                      const std::filesystem::path& path);

/// Writes all layers as a drawing (DXF of AutoCAD 2000): a layer of the drawing for each, in upper
/// case, and for their labels one whose name ends with _TEXT. Lines have elevations. Throws
/// FileError.
void write_dxf(const std::vector<VectorLayer>& layers, const std::filesystem::path& path);

/// Writes all features as one collection of GeoJSON; the attribute "layer" tells them apart.
/// `crs_name`: of the member `crs` of GeoJSON (2008), a WKT or "urn:ogc:def:crs:EPSG::n". Throws
/// FileError.
void write_geojson(const std::vector<VectorLayer>& layers, const std::string& crs_name,
                   const std::string& statement, const std::filesystem::path& path);

}  // namespace adit
