// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/section/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr double kStepM = 0.02;

/// Floor and roof of an outline over u, sampled; heights relative to the point inside.
struct OpenHeights {
  double from_m = 0.0;  ///< u of the first sample
  std::vector<double> floor_m;
  std::vector<double> roof_m;
};

/// Of the surfaces of the polygon over u, those nearest to the height of the point inside: what
/// overhangs beyond them is not open.
OpenHeights open_heights(const std::vector<Eigen::Vector2d>& corners) {
  OpenHeights open;
  double to_m = -std::numeric_limits<double>::infinity();
  open.from_m = -to_m;
  for (const Eigen::Vector2d& corner : corners) {
    open.from_m = std::min(open.from_m, corner.x());
    to_m = std::max(to_m, corner.x());
  }
  const auto samples = static_cast<std::size_t>(std::max(0.0, (to_m - open.from_m) / kStepM)) + 1;
  open.floor_m.assign(samples, -std::numeric_limits<double>::infinity());
  open.roof_m.assign(samples, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    const double low = std::min(a.x(), b.x());
    const double high = std::max(a.x(), b.x());
    const auto first = static_cast<std::size_t>(std::ceil((low - open.from_m) / kStepM));
    for (std::size_t k = first; k < samples; ++k) {
      const double u = open.from_m + kStepM * static_cast<double>(k);
      if (u > high) break;
      const double share = high > low ? (u - a.x()) / (b.x() - a.x()) : 0.5;
      const double z = a.y() + share * (b.y() - a.y());
      if (z < 0.0) {
        open.floor_m[k] = std::max(open.floor_m[k], z);
      } else {
        open.roof_m[k] = std::min(open.roof_m[k], z);
      }
    }
  }
  return open;
}

bool is_open(const OpenHeights& open, std::size_t i) {
  return std::isfinite(open.floor_m[i]) && std::isfinite(open.roof_m[i]);
}

/// Room to one side of samples for what reaches from `floor_m` to `top_m`.
double room_m(const OpenHeights& open, std::size_t from, int step, double floor_m, double top_m) {
  double room = 0.0;
  for (auto i = static_cast<std::ptrdiff_t>(from) + step;
       i >= 0 && i < static_cast<std::ptrdiff_t>(open.floor_m.size()); i += step) {
    const auto at = static_cast<std::size_t>(i);
    if (!is_open(open, at) || open.floor_m[at] > floor_m || open.roof_m[at] < top_m) break;
    room += kStepM;
  }
  return room;
}

}  // namespace

std::vector<Envelope> usual_envelopes(const Vehicle& robot) {
  return {{"person", 0.7, 1.9}, {"cart", 1.2, 1.5}, {"robot", robot.width_m, robot.height_m}};
}

std::optional<Clearance> clearance_of(const CrossSection& section, const Envelope& envelope) {
  if (!section.has_area() || !std::isfinite(section.measures.height_m.value)) return std::nullopt;
  const OpenHeights open = open_heights(section.outline.corners());
  const auto width = static_cast<std::size_t>(std::ceil(envelope.width_m / kStepM)) + 1;
  Clearance best;
  best.above_m = -envelope.height_m;
  for (std::size_t first = 0; first + width <= open.floor_m.size(); ++first) {
    double floor_m = -std::numeric_limits<double>::infinity();
    double roof_m = std::numeric_limits<double>::infinity();
    bool all_open = true;
    for (std::size_t i = first; i < first + width; ++i) {
      all_open = all_open && is_open(open, i);
      floor_m = std::max(floor_m, open.floor_m[i]);
      roof_m = std::min(roof_m, open.roof_m[i]);
    }
    if (!all_open) continue;
    Clearance at;
    at.offset_m =
        open.from_m + kStepM * (static_cast<double>(first) + 0.5 * static_cast<double>(width - 1));
    at.above_m = roof_m - floor_m - envelope.height_m;
    if (at.fits()) {
      const double top_m = floor_m + envelope.height_m;
      at.beside_m = std::min(room_m(open, first, -1, floor_m, top_m),
                             room_m(open, first + width - 1, 1, floor_m, top_m));
    }
    // Among those that fit the one farthest from walls, otherwise the highest.
    const bool better =
        at.fits() && best.fits() ? at.beside_m > best.beside_m : at.above_m > best.above_m;
    if (better) best = at;
  }
  return best;
}

std::string clearance_table(const std::vector<CrossSection>& sections,
                            const std::vector<Envelope>& envelopes, const SurveyFrame& frame) {
  std::string table =
      "tunnel,chainage_m,x_m,y_m,envelope,width_m,height_m,fits,above_m,beside_m,offset_left_m\n";
  for (const CrossSection& section : sections) {
    const Eigen::Vector2d p = frame.in_grid(section.plane.p_survey);
    for (const Envelope& envelope : envelopes) {
      const auto clearance = clearance_of(section, envelope);
      if (!clearance) continue;
      fmt::format_to(std::back_inserter(table),
                     "{},{:.2f},{:.3f},{:.3f},{},{:.2f},{:.2f},{},{:.2f},{:.2f},{:.2f}\n",
                     section.plane.tunnel, section.plane.chainage_m, p.x(), p.y(), envelope.name,
                     envelope.width_m, envelope.height_m, clearance->fits() ? "yes" : "no",
                     clearance->above_m, clearance->beside_m, clearance->offset_m);
    }
  }
  return table;
}

}  // namespace adit
