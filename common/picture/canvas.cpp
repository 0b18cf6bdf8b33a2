// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/canvas.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "common/files/file_error.hpp"
#include "common/files/new_file.hpp"
#include "common/files/output_file.hpp"
#include "common/picture/palette.hpp"

namespace adit {

Canvas::Canvas(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      cairo_(cairo_create(surface_.get())) {}

void Canvas::colour(const Colour& colour) const {
  cairo_set_source_rgba(cairo(), colour.red, colour.green, colour.blue, colour.alpha);
}

void Canvas::fill_rectangle(double x, double y, double width, double height) const {
  cairo_rectangle(cairo(), x, y, width, height);
  cairo_fill(cairo());
}

void Canvas::disc(double x, double y, double radius) const {
  cairo_new_path(cairo());
  cairo_arc(cairo(), x, y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(cairo());
}

double Canvas::text_width(const std::string& text, double size, bool bold) const {
  cairo_select_font_face(cairo(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo(), text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string& text, double x, double y, double size, bool bold,
                  Align align) const {
  const double width = text_width(text, size, bold);  // also sets the font
  double left = x;
  if (align == Align::kCentre) left -= width / 2.0;
  if (align == Align::kRight) left -= width;
  cairo_move_to(cairo(), left, y);
  cairo_show_text(cairo(), text.c_str());
}

void Canvas::image(const RgbImage& image, int x, int y) const {
  const Canvas copy(image.width, image.height);
  copy.set(image);
  cairo_set_source_surface(cairo(), copy.surface_.get(), x, y);
  cairo_paint(cairo());
}

void Canvas::image(const RgbImage& image, double x, double y, double width, double height) const {
  const Canvas copy(image.width, image.height);
  copy.set(image);
  cairo_save(cairo());
  cairo_translate(cairo(), x, y);
  cairo_scale(cairo(), width / image.width, height / image.height);
  cairo_set_source_surface(cairo(), copy.surface_.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(cairo()),
                           width < image.width ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  cairo_rectangle(cairo(), 0.0, 0.0, image.width, image.height);
  cairo_fill(cairo());
  cairo_restore(cairo());
}

void Canvas::set(const RgbImage& image) const {
  cairo_surface_t* surface = surface_.get();
  cairo_surface_flush(surface);
  unsigned char* bytes = cairo_image_surface_get_data(surface);
  if (bytes == nullptr) return;
  for (int row = 0; row < image.height; ++row) {
    auto* line = reinterpret_cast<std::uint32_t*>(
        bytes + static_cast<std::ptrdiff_t>(row) * cairo_image_surface_get_stride(surface));
    for (int column = 0; column < image.width; ++column) {
      const auto& [red, green, blue] = image.at(column, row);
      line[column] =
          static_cast<std::uint32_t>(red) << 16U | static_cast<std::uint32_t>(green) << 8U | blue;
    }
  }
  cairo_surface_mark_dirty(surface);
}

namespace {

struct PngOutput {
  OutputFile file;
  std::exception_ptr failure;
};

/// No exception may pass through Cairo.
cairo_status_t write_to_output(void* output_of, const unsigned char* bytes, unsigned int size) {
  auto& output = *static_cast<PngOutput*>(output_of);
  try {
    output.file.write({reinterpret_cast<const char*>(bytes), size});
    return CAIRO_STATUS_SUCCESS;
  } catch (const FileError&) {
    output.failure = std::current_exception();
    return CAIRO_STATUS_WRITE_ERROR;
  }
}

}  // namespace

void Canvas::write_png(const std::filesystem::path& path) const {
  NewFile file(path);
  PngOutput output{OutputFile(file.part(), path), nullptr};
  const cairo_status_t status =
      cairo_surface_write_to_png_stream(surface_.get(), write_to_output, &output);
  if (output.failure) std::rethrow_exception(output.failure);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw FileError("cannot write " + path.string() + ": " + cairo_status_to_string(status));
  }
  output.file.close();
  file.publish();
}

double draw_text_block(const Canvas& canvas, const std::string& text, double left, double top,
                       double width, const TextStyle& style) {
  const auto draw = [&](const std::string& line) {
    canvas.text(line, left, top + style.size, style.size, style.bold, Align::kLeft);
    top += style.line;
  };
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    std::string longer = line;
    longer.append(line.empty() ? "" : " ").append(word);
    const bool fits = canvas.text_width(longer, style.size, style.bold) <= width;
    if (!fits && !line.empty()) draw(line);
    line = fits || line.empty() ? longer : word;
  }
  draw(line);
  return top;
}

namespace {

constexpr double kMargin = 24.0;  // margin of the sheet

}  // namespace

void write_sheet(const std::filesystem::path& path, double width, const DrawColumn& draw) {
  const double bottom = draw(Canvas(1, 1), kMargin, kMargin);
  const Canvas canvas(static_cast<int>(std::ceil(width + 2.0 * kMargin)),
                      static_cast<int>(std::ceil(bottom + kMargin)));
  canvas.colour(kOpen);
  cairo_paint(canvas.cairo());
  draw(canvas, kMargin, kMargin);
  canvas.write_png(path);
}

}  // namespace adit
