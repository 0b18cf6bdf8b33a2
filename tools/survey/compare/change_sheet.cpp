// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/change_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "common/grid/grid2.hpp"
#include "tools/survey/sheet/pdf_page.hpp"

namespace adit {
namespace {

constexpr double kWidthMm = 420.0;  // A3
constexpr double kHeightMm = 297.0;
constexpr double kMarginMm = 10.0;
constexpr double kTextMm = 118.0;  // at the right
constexpr double kCellM = 0.1;
constexpr double kGridMm = 40.0;  // at least, between lines
constexpr std::size_t kRowsMax = 22;
constexpr std::array<double, 9> kScales{50.0,   100.0,  200.0,  250.0,  500.0,
                                        1000.0, 2000.0, 5000.0, 10000.0};

constexpr Ink kText{0.0, 0.0, 0.0};
constexpr Ink kSeen{0.86, 0.86, 0.86};
constexpr Ink kLines{0.6, 0.6, 0.6};
constexpr Ink kGoneInk{0.80, 0.10, 0.10};
constexpr Ink kNearerInk{0.10, 0.35, 0.75};

/// What a cell of the map shows; of two the larger one.
enum class Shown : std::uint8_t { kNothing, kUnchanged, kGone, kNearer };

/// Cells of comparison on the page.
class MapView {
 public:
  explicit MapView(const CellBox& box)
      : frame_(Eigen::Vector2d(kMarginMm, kMarginMm),
               Eigen::Vector2d(kWidthMm - kMarginMm - kTextMm, kHeightMm - kMarginMm)) {
    const Eigen::Vector2d size = kCellM * box.size().cast<double>();
    middle_ = 0.5 * kCellM * (box.from + box.to).cast<double>();
    scale_ = kScales.back();
    for (const double scale : kScales) {
      if ((1000.0 / scale * size.array() > frame_.sizes().array()).any()) continue;
      scale_ = scale;
      break;
    }
  }
  [[nodiscard]] const Eigen::AlignedBox2d& frame() const { return frame_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d = 1000.0 / scale_ * (p - middle_);
    return frame_.center() + Eigen::Vector2d(d.x(), -d.y());
  }
  [[nodiscard]] Eigen::Vector2d in_comparison(const Eigen::Vector2d& mm) const {
    const Eigen::Vector2d d = scale_ / 1000.0 * (mm - frame_.center());
    return middle_ + Eigen::Vector2d(d.x(), -d.y());
  }

 private:
  Eigen::AlignedBox2d frame_;
  Eigen::Vector2d middle_{0.0, 0.0};
  double scale_ = 1000.0;
};

Grid2<Shown> cells_of(const std::vector<SurfaceDistance>& distances,
                      const std::vector<ChangeRegion>& regions) {
  CellBox box;
  for (const SurfaceDistance& at : distances) box = united(box, cell_of(at.p.head<2>(), kCellM));
  Grid2<Shown> cells(box, Shown::kNothing);
  for (const SurfaceDistance& at : distances) {
    if (at.is_measured()) cells.at(cell_of(at.p.head<2>(), kCellM)) = Shown::kUnchanged;
  }
  for (const ChangeRegion& region : regions) {
    for (const std::size_t core : region.cores)
      cells.at(cell_of(distances[core].p.head<2>(), kCellM)) =
          region.rock_gone ? Shown::kGone : Shown::kNearer;
  }
  return cells;
}

/// Rows of equal cells as one rectangle each.
void draw_cells(const Grid2<Shown>& cells, Shown shown, const Ink& ink, const MapView& view,
                PdfPage& page) {
  const CellBox& box = cells.box();
  for (int y = box.from.y(); y < box.to.y(); ++y) {
    for (int x = box.from.x(); x < box.to.x(); ++x) {
      if (cells.at({x, y}) != shown) continue;
      const int first = x;
      while (x < box.to.x() && cells.at({x, y}) == shown) ++x;
      Eigen::AlignedBox2d part(view.at(kCellM * Eigen::Vector2d(first, y)));
      part.extend(view.at(kCellM * Eigen::Vector2d(x, y + 1)));
      page.fill_rectangle(part, ink);
    }
  }
}

void draw_grid_lines(const MapView& view, const Eigen::Vector3d& origin, PdfPage& page) {
  double step_m = 1.0;
  while (1000.0 / view.scale() * step_m < kGridMm) step_m *= step_m < 5.0 ? 5.0 : 2.0;
  const Eigen::AlignedBox2d& frame = view.frame();
  const Eigen::Vector2d low =
      origin.head<2>() + view.in_comparison({frame.min().x(), frame.max().y()});
  const Eigen::Vector2d high =
      origin.head<2>() + view.in_comparison({frame.max().x(), frame.min().y()});
  for (double x = step_m * std::ceil(low.x() / step_m); x < high.x(); x += step_m) {
    const double at = view.at({x - origin.x(), 0.0}).x();
    page.line({{at, frame.min().y()}, {at, frame.max().y()}}, {kLines, 0.08});
    page.text({at + 0.8, frame.max().y() - 1.2}, fmt::format("{:.0f}", x + 0.0), 2.4, kLines);
  }
  for (double y = step_m * std::ceil(low.y() / step_m); y < high.y(); y += step_m) {
    const double at = view.at({0.0, y - origin.y()}).y();
    page.line({{frame.min().x(), at}, {frame.max().x(), at}}, {kLines, 0.08});
    page.text({frame.min().x() + 1.0, at - 0.8}, fmt::format("{:.0f}", y + 0.0), 2.4, kLines);
  }
}

/// Returns y below it.
double draw_table(const std::vector<ChangeRegion>& regions, double left, double top,
                  PdfPage& page) {
  constexpr std::array<double, 5> kColumnsMm{0.0, 8.0, 34.0, 52.0, 66.0};
  const auto row = [&](double y, const std::array<std::string, 5>& texts, const Ink& ink) {
    for (std::size_t i = 0; i < texts.size(); ++i)
      page.text({left + kColumnsMm[i], y}, texts[i], 2.3, ink);
  };
  row(top, {"", "volume (m³, 95 %)", "area (m²)", "most (m)", "what"}, kText);
  top += 4.0;
  for (std::size_t i = 0; i < std::min(regions.size(), kRowsMax); ++i, top += 3.6) {
    const ChangeRegion& region = regions[i];
    row(top,
        {fmt::format("{}", i + 1),
         fmt::format("{:+.2f} ± {:.2f}", region.volume_m3, 1.96 * region.volume_sd_m3),
         fmt::format("{:.1f}", region.area_m2), fmt::format("{:+.2f}", region.most_m),
         region.meaning()},
        region.rock_gone ? kGoneInk : kNearerInk);
  }
  if (regions.size() > kRowsMax)
    page.text({left, top},
              fmt::format("and {} smaller ones: changes.csv", regions.size() - kRowsMax), 2.3,
              kText);
  return top + 6.0;
}

}  // namespace

void write_change_sheet(const std::vector<SurfaceDistance>& distances,
                        const std::vector<ChangeRegion>& regions, const Eigen::Vector3d& origin,
                        const std::vector<std::string>& statements,
                        const std::filesystem::path& path) {
  const Grid2<Shown> cells = cells_of(distances, regions);
  const MapView view(cells.box());
  PdfPage page(path, kWidthMm, kHeightMm, "Change of a mine", "");
  page.clip(view.frame());
  draw_cells(cells, Shown::kUnchanged, kSeen, view, page);
  draw_grid_lines(view, origin, page);
  draw_cells(cells, Shown::kGone, kGoneInk, view, page);
  draw_cells(cells, Shown::kNearer, kNearerInk, view, page);
  for (std::size_t i = 0; i < std::min(regions.size(), kRowsMax); ++i)
    page.text(view.at(regions[i].p.head<2>()) + Eigen::Vector2d(1.5, -1.5),
              fmt::format("{}", i + 1), 3.2, kText);
  page.end_clip();
  page.rectangle(view.frame(), {kText, 0.35});

  const double left = view.frame().max().x() + 6.0;
  const double width = kWidthMm - kMarginMm - left;
  double top = kMarginMm + 6.0;
  page.text({left, top}, "Change of a mine", 5.0, kText);
  page.text({left, top += 6.0}, fmt::format("Scale 1:{:.0f}", view.scale()), 3.2, kText);
  page.text({left, top += 6.0}, "Grey: seen by both, no significant change", 2.6, kText);
  page.text({left, top += 4.0}, "Red: rock is gone", 2.6, kGoneInk);
  page.text({left, top += 4.0}, "Blue: nearer than before", 2.6, kNearerInk);
  top = draw_table(regions, left, top + 8.0, page);
  for (const std::string& statement : statements)
    top = page.paragraph({left, top}, width, statement, 2.6, kText) + 2.0;
  page.finish();
}

}  // namespace adit
