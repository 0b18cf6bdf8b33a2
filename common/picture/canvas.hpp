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

/// A sheet of pixels to draw on, origin at the upper left: cairo with its handles owned.
class Canvas {
 public:
  Canvas(int width, int height);

  [[nodiscard]] cairo_t* cairo() const { return cairo_.get(); }
  void colour(const Colour& colour) const;
  void fill_rectangle(double x, double y, double width, double height) const;
  void disc(double x, double y, double radius) const;
  /// `y` is that of the base line.
  void text(const std::string& text, double x, double y, double size, bool bold, Align align) const;

  /// Of text as it is drawn.
  [[nodiscard]] double text_width(const std::string& text, double size, bool bold) const;

  /// Pixel for pixel, its upper left corner at x, y.
  void image(const RgbImage& image, int x, int y) const;
  /// The same, stretched to a rectangle: its pixels stay squares where they are enlarged, and are
  /// averaged where they are made smaller.
  void image(const RgbImage& image, double x, double y, double width, double height) const;

  /// Throws std::runtime_error where the file cannot be written.
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
  double size = 17.0;  ///< of the letters [pixels]
  double line = 26.0;  ///< height of a line
  bool bold = false;
};

/// Draws words in as many lines as it takes to stay within a width. Returns where the last ends
/// [pixels].
double draw_text_block(const Canvas& canvas, const std::string& text, double left, double top,
                       double width, const TextStyle& style);

/// Draws from a place on and says where it ended, downwards [pixels].
using DrawDown = std::function<double(const Canvas& canvas, double left, double top)>;

/// A white sheet of so much width between its margins, as high as what is drawn on it. Draws
/// twice: to see how high that is, and on the sheet. Throws std::runtime_error where the file
/// cannot be written.
void write_sheet(const std::filesystem::path& path, double width, const DrawDown& draw);

}  // namespace adit
