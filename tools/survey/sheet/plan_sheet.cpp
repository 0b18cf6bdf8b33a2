// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/sheet/plan_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "tools/survey/sheet/pdf_page.hpp"

namespace adit {
namespace {

constexpr double kMarginMm = 10.0;
constexpr double kTitleBlockMm = 88.0;  // at the right
constexpr double kInsetMm = 9.0;        // of the plan in its frame, for coordinates
constexpr double kGridMm = 50.0;        // at least, between lines
constexpr std::array<double, 12> kScales{50.0,   100.0,  200.0,  250.0,   500.0,   1000.0,
                                         2000.0, 2500.0, 5000.0, 10000.0, 20000.0, 50000.0};

constexpr Ink kBlack{0.0, 0.0, 0.0};
constexpr Ink kRock{0.93, 0.90, 0.85};
constexpr Ink kGrey{0.6, 0.6, 0.6};
constexpr Ink kPale{0.80, 0.80, 0.80};
constexpr Ink kBlue{0.10, 0.35, 0.75};
constexpr Ink kOrange{0.80, 0.45, 0.0};
constexpr Ink kRed{0.80, 0.10, 0.10};
constexpr Ink kWater{0.10, 0.60, 0.85};
constexpr Ink kGreen{0.05, 0.55, 0.25};

const VectorLayer* find(const std::vector<VectorLayer>& layers, std::string_view name) {
  const auto found = std::ranges::find(layers, name, &VectorLayer::name);
  return found == layers.end() ? nullptr : &*found;
}

Eigen::AlignedBox2d extent_of(const std::vector<VectorLayer>& layers) {
  Eigen::AlignedBox2d box;
  for (const VectorLayer& layer : layers) {
    if (layer.name == "given_lines" || layer.name == "approaches") continue;  // may be far away
    for (const VectorFeature& feature : layer.features) {
      for (const Eigen::Vector3d& p : feature.points) box.extend(p.head<2>());
    }
  }
  return box;
}

/// 1, 2 or 5 times a power of ten, at least `value`.
double round_number(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= value - 1e-9) return factor * power;
  }
  return 10.0 * power;
}

/// The plan within its frame.
class PlanView {
 public:
  PlanView(const Eigen::AlignedBox2d& extent, const Paper& paper)
      : frame_(Eigen::Vector2d(kMarginMm, kMarginMm),
               Eigen::Vector2d(paper.width_mm - kMarginMm - kTitleBlockMm,
                               paper.height_mm - kMarginMm)),
        middle_(extent.isEmpty() ? Eigen::Vector2d(0.0, 0.0) : extent.center()) {
    const Eigen::Vector2d room = frame_.sizes() - Eigen::Vector2d::Constant(2.0 * kInsetMm);
    const Eigen::Vector2d size =
        extent.isEmpty() ? Eigen::Vector2d(1.0, 1.0) : Eigen::Vector2d(extent.sizes());
    scale_ = kScales.back();
    for (const double scale : kScales) {
      if ((1000.0 / scale * size.array() > room.array()).any()) continue;
      scale_ = scale;
      break;
    }
  }

  [[nodiscard]] const Eigen::AlignedBox2d& frame() const { return frame_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] double mm(double length_m) const { return 1000.0 / scale_ * length_m; }
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p_grid) const {
    const Eigen::Vector2d d = 1000.0 / scale_ * (p_grid - middle_);
    return frame_.center() + Eigen::Vector2d(d.x(), -d.y());
  }
  [[nodiscard]] Eigen::Vector2d in_grid(const Eigen::Vector2d& p_mm) const {
    const Eigen::Vector2d d = scale_ / 1000.0 * (p_mm - frame_.center());
    return middle_ + Eigen::Vector2d(d.x(), -d.y());
  }
  [[nodiscard]] std::vector<Eigen::Vector2d> line(const VectorFeature& feature) const {
    std::vector<Eigen::Vector2d> line;
    for (const Eigen::Vector3d& p : feature.points) line.push_back(at(p.head<2>()));
    return line;
  }

 private:
  Eigen::AlignedBox2d frame_;
  Eigen::Vector2d middle_;
  double scale_ = 1000.0;
};

void draw_grid(const PlanView& view, PdfPage& page) {
  const double step_m = round_number(view.scale() / 1000.0 * kGridMm);
  const Eigen::Vector2d low = view.in_grid({view.frame().min().x(), view.frame().max().y()});
  const Eigen::Vector2d high = view.in_grid({view.frame().max().x(), view.frame().min().y()});
  for (double x = step_m * std::ceil(low.x() / step_m); x < high.x(); x += step_m) {
    const double at = view.at({x, low.y()}).x();
    page.line({{at, view.frame().min().y()}, {at, view.frame().max().y()}}, {kPale, 0.1});
    page.text({at + 0.8, view.frame().max().y() - 1.2}, fmt::format("{:.0f}", x + 0.0), 2.4, kGrey);
  }
  for (double y = step_m * std::ceil(low.y() / step_m); y < high.y(); y += step_m) {
    const double at = view.at({low.x(), y}).y();
    page.line({{view.frame().min().x(), at}, {view.frame().max().x(), at}}, {kPale, 0.1});
    page.text({view.frame().min().x() + 1.0, at - 0.8}, fmt::format("{:.0f}", y + 0.0), 2.4, kGrey);
  }
}

void draw_lines(const VectorLayer* layer, const PlanView& view, const Pen& pen, PdfPage& page) {
  if (layer == nullptr) return;
  for (const VectorFeature& feature : layer->features) page.line(view.line(feature), pen);
}

/// Void between the outlines of walls and pillars.
void draw_void(const std::vector<VectorLayer>& layers, const PlanView& view, PdfPage& page) {
  std::vector<std::vector<Eigen::Vector2d>> rings;
  for (const char* name : {"walls", "pillars"}) {
    const VectorLayer* const layer = find(layers, name);
    if (layer == nullptr) continue;
    for (const VectorFeature& feature : layer->features) rings.push_back(view.line(feature));
  }
  page.fill(rings, kRock);
}

/// Texts of a page, none of which overlaps another: one that would is left out.
class Labels {
 public:
  explicit Labels(PdfPage& page) : page_(page) {}

  void add(const Eigen::Vector2d& at, const std::string& text, double size_mm, const Ink& ink) {
    const double width_mm = kWidthShare * size_mm * static_cast<double>(text.size());
    const Eigen::AlignedBox2d box(at - Eigen::Vector2d(0.0, size_mm),
                                  at + Eigen::Vector2d(width_mm, 0.2 * size_mm));
    if (std::ranges::any_of(boxes_, [&](const auto& other) { return other.intersects(box); }))
      return;
    boxes_.push_back(box);
    page_.text(at, text, size_mm, ink);
  }

 private:
  static constexpr double kWidthShare = 0.6;  // of a character, of its size

  PdfPage& page_;
  std::vector<Eigen::AlignedBox2d> boxes_;
};

void draw_points(const VectorLayer* layer, const PlanView& view, Mark mark, const Ink& ink,
                 double size_mm, PdfPage& page, Labels& labels) {
  if (layer == nullptr) return;
  for (const VectorFeature& feature : layer->features) {
    if (feature.label.empty()) continue;
    const Eigen::Vector2d at = view.at(feature.points.front().head<2>());
    page.mark(at, mark, size_mm, ink);
    labels.add(at + Eigen::Vector2d(1.2, 0.8), feature.label, 2.0, ink);
  }
}

void draw_labels(const VectorLayer* layer, const PlanView& view, double size_mm, const Ink& ink,
                 Labels& labels) {
  if (layer == nullptr) return;
  for (const VectorFeature& feature : layer->features) {
    const Eigen::Vector3d& p = feature.points[feature.points.size() / 2];
    labels.add(view.at(p.head<2>()) + Eigen::Vector2d(0.6, -0.6), feature.label, size_mm, ink);
  }
}

void draw_plan(const std::vector<VectorLayer>& layers, const PlanView& view, PdfPage& page) {
  page.clip(view.frame());
  draw_void(layers, view, page);
  draw_grid(view, page);
  draw_lines(find(layers, "floor_contours"), view, {kGrey, 0.1}, page);
  draw_lines(find(layers, "water"), view, {kWater, 0.25}, page);
  draw_lines(find(layers, "walls"), view, {kBlack, 0.3}, page);
  draw_lines(find(layers, "pillars"), view, {kBlack, 0.3}, page);
  draw_lines(find(layers, "centre_lines"), view, {kBlue, 0.15, true}, page);
  draw_lines(find(layers, "given_lines"), view, {kOrange, 0.3, true}, page);
  draw_lines(find(layers, "approaches"), view, {kOrange, 0.15}, page);
  Labels labels(page);  // the most important first
  draw_points(find(layers, "control"), view, Mark::kTriangle, kGreen, 2.4, page, labels);
  draw_labels(find(layers, "approaches"), view, 2.4, kOrange, labels);
  draw_labels(find(layers, "centre_lines"), view, 2.8, kBlue, labels);
  draw_points(find(layers, "frontiers"), view, Mark::kCircle, kOrange, 1.4, page, labels);
  draw_points(find(layers, "sections"), view, Mark::kCross, kBlack, 0.8, page, labels);
  draw_points(find(layers, "hazards"), view, Mark::kTriangle, kRed, 1.6, page, labels);
  page.end_clip();
  page.rectangle(view.frame(), {kBlack, 0.35});
}

/// Returns the place below it.
double draw_scale_bar(const PlanView& view, double left, double top, PdfPage& page) {
  const double part_m = round_number(view.scale() / 1000.0 * 8.0);
  page.text({left, top}, fmt::format("Scale 1:{:.0f}", view.scale()), 3.6, kBlack);
  for (int i = 0; i < 4; ++i) {
    const Eigen::AlignedBox2d part(Eigen::Vector2d(left + view.mm(part_m) * i, top + 2.0),
                                   Eigen::Vector2d(left + view.mm(part_m) * (i + 1), top + 4.0));
    if (i % 2 == 0) page.fill_rectangle(part, kBlack);
    page.rectangle(part, {kBlack, 0.15});
    page.text({part.min().x(), top + 7.2}, fmt::format("{:g}", part_m * i), 2.4, kBlack);
  }
  page.text({left + view.mm(part_m) * 4.0, top + 7.2}, fmt::format("{:g} m", part_m * 4.0), 2.4,
            kBlack);
  return top + 14.0;
}

double draw_arrow(bool grid_north, double left, double top, PdfPage& page) {
  page.line({{left + 4.0, top + 16.0}, {left + 4.0, top}}, {kBlack, 0.4});
  page.line({{left + 2.0, top + 5.0}, {left + 4.0, top}, {left + 6.0, top + 5.0}}, {kBlack, 0.4});
  page.text({left + 9.0, top + 6.0}, grid_north ? "N" : "y", 5.0, kBlack);
  page.text({left + 9.0, top + 11.0}, grid_north ? "grid north" : "y axis of the grid, not north",
            2.6, kBlack);
  return top + 24.0;
}

double draw_legend(double left, double top, PdfPage& page) {
  const auto row = [&](int i) { return top + 5.0 * i; };
  const auto name = [&](int i, const char* text) {
    page.text({left + 14.0, row(i) + 0.9}, text, 2.6, kBlack);
  };
  const auto sample = [&](int i, const Pen& pen) {
    page.line({{left, row(i)}, {left + 10.0, row(i)}}, pen);
  };
  page.text({left, row(0)}, "Legend", 3.2, kBlack);
  sample(1, {kBlack, 0.3});
  name(1, "wall, pillar, end of what was seen");
  sample(2, {kGrey, 0.1});
  name(2, "contour of the floor, each 0.25 m");
  sample(3, {kBlue, 0.15, true});
  name(3, "centre line of a tunnel, with its number");
  page.mark({left + 5.0, row(4)}, Mark::kCross, 0.8, kBlack);
  name(4, "section, elevation of the floor (m)");
  page.mark({left + 5.0, row(5)}, Mark::kCircle, 1.4, kOrange);
  name(5, "frontier that is not explored");
  page.mark({left + 5.0, row(6)}, Mark::kTriangle, 1.6, kRed);
  name(6, "hazard");
  page.mark({left + 5.0, row(7)}, Mark::kTriangle, 2.4, kGreen);
  name(7, "control point");
  sample(8, {kWater, 0.25});
  name(8, "standing water, hollow, flooded");
  sample(9, {kOrange, 0.3, true});
  name(9, "given line, its distance from the workings");
  return row(10) + 3.0;
}

void draw_title_block(const PlanView& view, const PlanSheetText& text, PdfPage& page) {
  const double left = view.frame().max().x() + 6.0;
  const double width = kTitleBlockMm - 6.0;
  double top = kMarginMm + 6.0;
  page.text({left, top}, text.title, 5.0, kBlack);
  page.text({left, top + 6.0}, text.date, 3.0, kBlack);
  top = page.paragraph({left, top + 11.0}, width, text.identity, 2.4, kGrey) + 6.0;
  top = draw_scale_bar(view, left, top, page);
  top = draw_arrow(text.grid_north, left, top, page);
  top = draw_legend(left, top, page);
  for (const std::string& statement : text.statements)
    top = page.paragraph({left, top}, width, statement, 2.7, kBlack) + 2.5;
}

}  // namespace

void write_plan_sheet(const std::vector<VectorLayer>& layers, const PlanSheetText& text,
                      const Paper& paper, const std::filesystem::path& path) {
  PdfPage page(path, paper.width_mm, paper.height_mm, text.title, text.date);
  const PlanView view(extent_of(layers), paper);
  draw_plan(layers, view, page);
  draw_title_block(view, text, page);
  page.finish();
}

}  // namespace adit
