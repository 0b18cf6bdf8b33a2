// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/sheet/pdf_page.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kLineSpacing = 1.35;  // of the size of letters

}  // namespace

struct PdfPage::Cairo {
  cairo_surface_t* surface = nullptr;
  cairo_t* context = nullptr;

  void set(const Ink& ink) const { cairo_set_source_rgb(context, ink.red, ink.green, ink.blue); }
  void set(const Pen& pen) const {
    set(pen.ink);
    cairo_set_line_width(context, pen.width_mm);
    constexpr double kDash[] = {1.6, 1.0};
    cairo_set_dash(context, kDash, pen.dashed ? 2 : 0, 0.0);
  }
  void add(const std::vector<Eigen::Vector2d>& points) const {
    cairo_new_sub_path(context);
    for (const Eigen::Vector2d& p : points) cairo_line_to(context, p.x(), p.y());
  }
  void add(const Eigen::AlignedBox2d& box) const {
    cairo_rectangle(context, box.min().x(), box.min().y(), box.sizes().x(), box.sizes().y());
  }
  [[nodiscard]] double width(const std::string& text) const {
    cairo_text_extents_t extents;
    cairo_text_extents(context, text.c_str(), &extents);
    return extents.x_advance;
  }
};

PdfPage::PdfPage(const std::filesystem::path& path, double width_mm, double height_mm,
                 const std::string& title, const std::string& date)
    : path_(path), cairo_(std::make_unique<Cairo>()) {
  cairo_->surface =
      cairo_pdf_surface_create(path.c_str(), kPointsPerMm * width_mm, kPointsPerMm * height_mm);
  cairo_pdf_surface_set_metadata(cairo_->surface, CAIRO_PDF_METADATA_TITLE, title.c_str());
  // "2003-05-30 00:12:07 UTC" as ISO 8601.
  std::string iso = date.substr(0, 19);
  if (iso.size() == 19) {
    iso[10] = 'T';
    iso += "Z";
    cairo_pdf_surface_set_metadata(cairo_->surface, CAIRO_PDF_METADATA_CREATE_DATE, iso.c_str());
    cairo_pdf_surface_set_metadata(cairo_->surface, CAIRO_PDF_METADATA_MOD_DATE, iso.c_str());
  }
  cairo_->context = cairo_create(cairo_->surface);
  cairo_scale(cairo_->context, kPointsPerMm, kPointsPerMm);
  cairo_set_line_join(cairo_->context, CAIRO_LINE_JOIN_ROUND);
  cairo_select_font_face(cairo_->context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
}

PdfPage::~PdfPage() {
  cairo_destroy(cairo_->context);
  cairo_surface_destroy(cairo_->surface);
}

void PdfPage::line(const std::vector<Eigen::Vector2d>& points, const Pen& pen) {
  cairo_->set(pen);
  cairo_->add(points);
  cairo_stroke(cairo_->context);
}

void PdfPage::rectangle(const Eigen::AlignedBox2d& box, const Pen& pen) {
  cairo_->set(pen);
  cairo_->add(box);
  cairo_stroke(cairo_->context);
}

void PdfPage::fill_rectangle(const Eigen::AlignedBox2d& box, const Ink& ink) {
  cairo_->set(ink);
  cairo_->add(box);
  cairo_fill(cairo_->context);
}

void PdfPage::fill(const std::vector<std::vector<Eigen::Vector2d>>& rings, const Ink& ink) {
  cairo_->set(ink);
  cairo_set_fill_rule(cairo_->context, CAIRO_FILL_RULE_EVEN_ODD);
  for (const auto& ring : rings) {
    cairo_->add(ring);
    cairo_close_path(cairo_->context);
  }
  cairo_fill(cairo_->context);
}

void PdfPage::mark(const Eigen::Vector2d& at, Mark mark, double size_mm, const Ink& ink) {
  cairo_->set(Pen{ink, 0.25});
  const double r = size_mm;
  switch (mark) {
    case Mark::kCross:
      cairo_move_to(cairo_->context, at.x() - r, at.y());
      cairo_line_to(cairo_->context, at.x() + r, at.y());
      cairo_move_to(cairo_->context, at.x(), at.y() - r);
      cairo_line_to(cairo_->context, at.x(), at.y() + r);
      break;
    case Mark::kCircle:
      cairo_new_sub_path(cairo_->context);
      cairo_arc(cairo_->context, at.x(), at.y(), r, 0.0, 2.0 * std::numbers::pi);
      break;
    case Mark::kTriangle:
      cairo_->add(
          {{at.x() - r, at.y() + 0.6 * r}, {at.x() + r, at.y() + 0.6 * r}, {at.x(), at.y() - r}});
      cairo_close_path(cairo_->context);
      break;
  }
  cairo_stroke(cairo_->context);
}

void PdfPage::text(const Eigen::Vector2d& at, const std::string& text, double size_mm,
                   const Ink& ink) {
  cairo_->set(ink);
  cairo_set_font_size(cairo_->context, size_mm);
  cairo_move_to(cairo_->context, at.x(), at.y());
  cairo_show_text(cairo_->context, text.c_str());
}

double PdfPage::paragraph(const Eigen::Vector2d& at, double width_mm, const std::string& text,
                          double size_mm, const Ink& ink) {
  cairo_set_font_size(cairo_->context, size_mm);
  Eigen::Vector2d base = at;
  std::istringstream words(text);
  std::string line;
  const auto end_line = [&] {
    this->text(base, line, size_mm, ink);
    base.y() += kLineSpacing * size_mm;
    line.clear();
  };
  for (std::string word; words >> word;) {
    std::string longer = line;
    if (!line.empty()) longer += ' ';
    longer += word;
    if (!line.empty() && cairo_->width(longer) > width_mm) {
      end_line();
      line = word;
    } else {
      line = std::move(longer);
    }
  }
  if (!line.empty()) end_line();
  return base.y();
}

void PdfPage::clip(const Eigen::AlignedBox2d& box) {
  cairo_save(cairo_->context);
  cairo_->add(box);
  cairo_clip(cairo_->context);
}

void PdfPage::end_clip() { cairo_restore(cairo_->context); }

void PdfPage::next_page() { cairo_show_page(cairo_->context); }

void PdfPage::finish() {
  cairo_show_page(cairo_->context);
  cairo_surface_finish(cairo_->surface);
  const cairo_status_t status = cairo_surface_status(cairo_->surface);
  if (status != CAIRO_STATUS_SUCCESS)
    throw FileError(
        fmt::format("cannot write {}: {}", path_.string(), cairo_status_to_string(status)));
}

}  // namespace adit
