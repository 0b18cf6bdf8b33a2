// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <cairo.h>

#include "common/picture/rgb_image.hpp"

namespace adit {

enum class Align { kLeft, kCentre, kRight };

/// A pixel surface, origin at the upper left: cairo with owned handles.
class Canvas {
 public:
  Canvas(int width, int height);

  [[nodiscard]] cairo_t* cairo() const { return cairo_.get(); }
  void colour(const Colour& colour) const;
  void fill_rectangle(double x, double y, double width, double height) const;
  void disc(double x, double y, double radius) const;
  /// `y` is that of the base line.
  void text(const std::string& text, double x, double y, double size, bool bold, Align align) const;

  /// Width of a text as drawn [pixels].
  [[nodiscard]] double text_width(const std::string& text, double size, bool bold) const;

  /// Copies an image, its upper left corner at x, y.
  void image(const RgbImage& image, int x, int y) const;
  /// Copies an image, scaled to a rectangle: enlarged pixels stay squares, reduced pixels are
  /// averaged.
  void image(const RgbImage& image, double x, double y, double width, double height) const;

  /// Throws std::runtime_error if the file cannot be written.
  void write_png(const std::filesystem::path& path) const;

 private:
  void set(const RgbImage& image) const;

  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  };

  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> cairo_;
};

struct TextStyle {
  double size = 17.0;  ///< font size [pixels]
  double line = 26.0;  ///< height of a line [pixels]
  bool bold = false;
};

/// Draws a text with line breaks at a width. Returns the lower end of the last line [pixels].
double draw_text_block(const Canvas& canvas, const std::string& text, double left, double top,
                       double width, const TextStyle& style);

/// Draws downwards from a position and returns the lower end [pixels].
using DrawColumn = std::function<double(const Canvas& canvas, double left, double top)>;

/// Writes a white sheet of a width, without its margins, as high as its content. Calls `draw`
/// twice: to measure the height, and to draw. Throws std::runtime_error if the file cannot be
/// written.
void write_sheet(const std::filesystem::path& path, double width, const DrawColumn& draw);

}  // namespace adit
