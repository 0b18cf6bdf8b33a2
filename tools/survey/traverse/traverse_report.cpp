// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/traverse/traverse_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "tools/survey/sheet/pdf_page.hpp"

namespace adit {
namespace {

constexpr double kPaperWidthMm = 210.0;  // A4
constexpr double kPaperHeightMm = 297.0;
constexpr double kBorderMm = 18.0;
constexpr double kLineMm = 4.6;
constexpr std::size_t kStationsMax = 48;
constexpr std::size_t kLoopsMax = 24;
constexpr std::size_t kNarrowMax = 16;
constexpr double kLargestEllipseShare = 0.04;  // of the plan, as drawn
constexpr int kEllipseCorners = 36;

constexpr Ink kBlackInk{0.0, 0.0, 0.0};
constexpr Ink kGreyInk{0.55, 0.55, 0.55};
constexpr Ink kWallInk{0.70, 0.70, 0.70};
constexpr Ink kBlueInk{0.10, 0.35, 0.75};
constexpr Ink kRedInk{0.80, 0.10, 0.10};

/// Rows of text with columns at given places.
class Table {
 public:
  Table(PdfPage& page, std::vector<double> columns_mm, double top)
      : page_(page), columns_mm_(std::move(columns_mm)), top_(top) {}

  void row(const std::vector<std::string>& cells, const Ink& ink = kBlackInk) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      page_.text({kBorderMm + columns_mm_[i], top_}, cells[i], 2.8, ink);
    top_ += kLineMm;
  }
  [[nodiscard]] double bottom() const { return top_; }

 private:
  PdfPage& page_;
  std::vector<double> columns_mm_;
  double top_;
};

std::string length(double metres) {
  return std::isfinite(metres) ? fmt::format("{:.3f}", metres) : std::string("–");
}

double heading(PdfPage& page, double top, const std::string& text) {
  page.text({kBorderMm, top}, text, 4.2, kBlackInk);
  return top + 7.0;
}

void draw_summary(const TraverseReport& report, PdfPage& page) {
  double top = kBorderMm + 4.0;
  page.text({kBorderMm, top}, "Survey report", 6.0, kBlackInk);
  page.text({kBorderMm, top += 7.0}, report.text.date, 3.0, kBlackInk);
  const double width = kPaperWidthMm - 2.0 * kBorderMm;
  top = page.paragraph({kBorderMm, top + 6.0}, width, report.text.identity, 2.6, kGreyInk) + 4.0;
  for (const std::string& statement : report.text.statements)
    top = page.paragraph({kBorderMm, top}, width, statement, 3.0, kBlackInk) + 2.0;
  top = heading(page, top + 6.0, "Accuracy budget (standard deviations)");
  Table table(page, {0.0, 110.0, 140.0}, top);
  table.row({"source", "plan (m)", "elevation (m)"}, kGreyInk);
  for (const BudgetRow& row : report.budget)
    table.row({row.source, length(row.plan_sd_m), length(row.z_sd_m)});
  page.paragraph(
      {kBorderMm, table.bottom() + 2.0}, width,
      "In plan the worst direction. They come from the covariances of the adjusted pose "
      "graph, the levelling of the 3D scans by their overlap, and the range of the lasers; "
      "none is a figure of a data sheet but that of the range.",
      2.6, kGreyInk);
}

/// The plan to the largest scale that fits a page.
class ReportPlan {
 public:
  ReportPlan(const Eigen::AlignedBox2d& extent, double top)
      : frame_(Eigen::Vector2d(kBorderMm, top),
               Eigen::Vector2d(kPaperWidthMm - kBorderMm, kPaperHeightMm - kBorderMm)),
        middle_(extent.center()) {
    const Eigen::Array2d size = extent.sizes().array().max(1.0);
    mm_per_m_ = (frame_.sizes().array() / size).minCoeff();
  }
  [[nodiscard]] double mm_per_m() const { return mm_per_m_; }
  [[nodiscard]] const Eigen::AlignedBox2d& frame() const { return frame_; }
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p_grid) const {
    const Eigen::Vector2d d = mm_per_m_ * (p_grid - middle_);
    return frame_.center() + Eigen::Vector2d(d.x(), -d.y());
  }

 private:
  Eigen::AlignedBox2d frame_;
  Eigen::Vector2d middle_;
  double mm_per_m_ = 1.0;
};

std::vector<Eigen::Vector2d> ring_of(const Ellipse95& ellipse, const Eigen::Vector2d& at,
                                     double mm_per_m) {
  const Eigen::Vector2d minor_axis(-ellipse.major_axis.y(), ellipse.major_axis.x());
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i <= kEllipseCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kEllipseCorners;
    const Eigen::Vector2d d = ellipse.major_m * std::cos(angle) * ellipse.major_axis +
                              ellipse.minor_m * std::sin(angle) * minor_axis;
    ring.emplace_back(at + mm_per_m * Eigen::Vector2d(d.x(), -d.y()));
  }
  return ring;
}

void draw_traverse(const std::vector<VectorLayer>& layers, const SurveyGraph& graph,
                   const SurveyFrame& frame, PdfPage& page) {
  const double top = heading(page, kBorderMm + 4.0, "Traverse with 95 % ellipses");
  Eigen::AlignedBox2d extent;
  double largest_m = 0.0;
  std::vector<Eigen::Vector2d> line;
  for (const SurveyGraph::Node& node : graph.nodes()) {
    extent.extend(frame.in_grid(node.T_survey_local.plan.translation()));
    largest_m = std::max(largest_m, ellipse_95(node).major_m);
  }
  for (const VectorLayer& layer : layers) {
    if (layer.name != "walls" && layer.name != "pillars") continue;
    for (const VectorFeature& feature : layer.features) {
      for (const Eigen::Vector3d& p : feature.points) extent.extend(p.head<2>());
    }
  }
  const ReportPlan plan(extent, top + 8.0);
  for (const VectorLayer& layer : layers) {
    if (layer.name != "walls" && layer.name != "pillars") continue;
    for (const VectorFeature& feature : layer.features) {
      std::vector<Eigen::Vector2d> wall;
      for (const Eigen::Vector3d& p : feature.points) wall.push_back(plan.at(p.head<2>()));
      page.line(wall, {kWallInk, 0.15});
    }
  }
  const double share_m = kLargestEllipseShare * plan.frame().sizes().maxCoeff() / plan.mm_per_m();
  double factor = 1.0;
  while (largest_m > 0.0 && factor < 1000.0 && 2.0 * factor * largest_m < share_m) factor *= 2.0;
  for (const SurveyGraph::Node& node : graph.nodes()) {
    const Eigen::Vector2d at = plan.at(frame.in_grid(node.T_survey_local.plan.translation()));
    line.push_back(at);
    page.line(ring_of(ellipse_95(node), at, factor * plan.mm_per_m()), {kRedInk, 0.15});
  }
  page.line(line, {kBlueInk, 0.2});
  page.text({kBorderMm, top},
            fmt::format("{} stations (local maps); ellipses {:.0f} times as large as the plan, the "
                        "largest {:.3f} m",
                        graph.nodes().size(), factor, largest_m),
            2.8, kGreyInk);
}

void draw_stations(const SurveyGraph& graph, const SurveyFrame& frame, PdfPage& page) {
  const double top = heading(page, kBorderMm + 4.0, "Stations");
  const std::size_t count = graph.nodes().size();
  const std::size_t step = (count + kStationsMax - 1) / kStationsMax;
  Table table(page, {0.0, 20.0, 50.0, 80.0, 102.0, 126.0, 150.0}, top);
  table.row({"station", "x (m)", "y (m)", "z (m)", "± z, 95 %", "ellipse, 95 % (m)", "bearing (°)"},
            kGreyInk);
  for (std::size_t i = 0; i < count; i += step) {
    const SurveyGraph::Node& node = graph.nodes()[i];
    const Eigen::Vector3d p = frame.in_grid(node.T_survey_local.translation());
    const Ellipse95 ellipse = ellipse_95(node);
    const double bearing = rad_to_deg(std::atan2(ellipse.major_axis.x(), ellipse.major_axis.y()));
    table.row({fmt::format("{}", node.id), fmt::format("{:.3f}", p.x()),
               fmt::format("{:.3f}", p.y()), fmt::format("{:.3f}", p.z()),
               fmt::format("{:.3f}", 1.96 * std::sqrt(node.z_variance)),
               fmt::format("{:.3f} × {:.3f}", ellipse.major_m, ellipse.minor_m),
               fmt::format("{:.0f}", bearing < 0.0 ? bearing + 180.0 : bearing)});
  }
  if (step > 1)
    page.text({kBorderMm, table.bottom() + 2.0},
              fmt::format("Every {}th of {}; all are in the layer traverse.", step, count), 2.6,
              kGreyInk);
}

void draw_loops(const TraverseReport& report, PdfPage& page) {
  const double width = kPaperWidthMm - 2.0 * kBorderMm;
  double top = heading(page, kBorderMm + 4.0, "Misclosures of loops");
  if (report.loops.empty()) {
    top = page.paragraph({kBorderMm, top}, width,
                         "The traverse has no loop: nothing checks it but its own residuals.", 2.8,
                         kBlackInk);
  } else {
    Table table(page, {0.0, 40.0, 70.0, 100.0, 125.0, 150.0}, top);
    table.row({"local maps", "length (m)", "misses by (m)", "(°)", "one in", "chi² (3)"}, kGreyInk);
    for (std::size_t i = 0; i < std::min(report.loops.size(), kLoopsMax); ++i) {
      const TraverseLoop& loop = report.loops[i];
      table.row({fmt::format("{} – {}", loop.from, loop.to), fmt::format("{:.1f}", loop.length_m),
                 fmt::format("{:.3f}", loop.misclosure_m),
                 fmt::format("{:.2f}", rad_to_deg(loop.misclosure_rad)),
                 fmt::format("{:.0f}", loop.length_m / std::max(1e-4, loop.misclosure_m)),
                 fmt::format("{:.1f}", loop.chi2)});
    }
    top = page.paragraph(
        {kBorderMm, table.bottom() + 2.0}, width,
        fmt::format("{} loops, the worst first (all: loops.csv). The traverse between both local "
                    "maps, followed without any loop closure, misses the loop closure by this; "
                    "chi² is what "
                    "both state of it, 95 % are below 7.8.",
                    report.loops.size()),
        2.6, kGreyInk);
  }
  top = heading(page, top + 8.0, "Clearance");
  std::string envelopes;
  for (const std::string& envelope : report.envelopes)
    envelopes += (envelopes.empty() ? "" : ", ") + envelope;
  top = page.paragraph({kBorderMm, top}, width,
                       fmt::format("Envelopes: {}. Sections where one does not fit, or passes "
                                   "within 0.2 m, the narrowest first (all: clearance.csv):",
                                   envelopes),
                       2.8, kBlackInk) +
        2.0;
  if (report.narrow.empty()) {
    page.text({kBorderMm, top}, "none", 2.8, kBlackInk);
    return;
  }
  Table table(page, {0.0, 50.0, 90.0, 130.0}, top);
  table.row({"section", "envelope", "above (m)", "beside (m)"}, kGreyInk);
  for (std::size_t i = 0; i < std::min(report.narrow.size(), kNarrowMax); ++i) {
    const NarrowPlace& at = report.narrow[i];
    table.row({at.place, at.envelope, fmt::format("{:+.2f}", at.above_m),
               fmt::format("{:.2f}", at.beside_m)},
              at.above_m < 0.0 ? kRedInk : kBlackInk);
  }
  if (report.narrow.size() > kNarrowMax)
    table.row({fmt::format("and {} more", report.narrow.size() - kNarrowMax)}, kGreyInk);
}

}  // namespace

void write_traverse_report(const TraverseReport& report, const std::vector<VectorLayer>& layers,
                           const SurveyGraph& graph, const SurveyFrame& frame,
                           const std::filesystem::path& path) {
  PdfPage page(path, kPaperWidthMm, kPaperHeightMm, "Survey report", report.text.date);
  draw_summary(report, page);
  page.next_page();
  draw_traverse(layers, graph, frame, page);
  page.next_page();
  draw_stations(graph, frame, page);
  page.next_page();
  draw_loops(report, page);
  page.finish();
}

}  // namespace adit
