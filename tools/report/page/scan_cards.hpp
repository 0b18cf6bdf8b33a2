// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/report/mission_statistics.hpp"
#include "tools/report/svg/map_svg.hpp"

namespace adit {

/// The message of the topic /scans (viewer/README.md) for a 3D scan with its pictures, JSON. Its
/// pose is that of the robot on the map at the end.
std::string scan_message(const RecordedScan& scan, const MissionMap& map);

/// Marks of the scans on the map. Scans without a pose on the map are left out.
std::vector<ScanMark> scan_marks(const MissionRecords& records, const MissionMap& map);

}  // namespace adit
