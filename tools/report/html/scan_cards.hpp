// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/report/mission_statistics.hpp"
#include "tools/report/svg/map_svg.hpp"

namespace adit {

/// Result of the last plan on a scan, one sentence.
std::string outcome_text(const RecordedScan& scan);

/// Marks of the scans on the map. Scans without a pose on the map are left out.
std::vector<ScanMark> scan_marks(const MissionRecords& records, const MissionMap& map);

/// A legend and one card for each 3D scan, as HTML.
std::string scan_cards(const MissionRecords& records, const MissionMap& map);

}  // namespace adit
