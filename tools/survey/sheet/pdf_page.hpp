// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace adit {

/// Colour, each part 0 to 1.
struct Ink {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

struct Pen {
  Ink ink;
  double width_mm = 0.2;
  bool dashed = false;
};

enum class Mark : std::uint8_t { kCross, kCircle, kTriangle };

/// A PDF, drawn in millimetres from the upper left corner of a page, y down. The class that knows
/// cairo's PDF. The same calls give the same bytes.
class PdfPage {
 public:
  /// `date`: "2003-05-30 00:12:07 UTC", stored as that of the document. Errors are reported by
  /// `finish`.
  PdfPage(const std::filesystem::path& path, double width_mm, double height_mm,
          const std::string& title, const std::string& date);
  ~PdfPage();
  PdfPage(const PdfPage&) = delete;
  PdfPage& operator=(const PdfPage&) = delete;

  void line(const std::vector<Eigen::Vector2d>& points, const Pen& pen);
  void rectangle(const Eigen::AlignedBox2d& box, const Pen& pen);
  void fill_rectangle(const Eigen::AlignedBox2d& box, const Ink& ink);
  /// Fills what an odd number of rings encloses.
  void fill(const std::vector<std::vector<Eigen::Vector2d>>& rings, const Ink& ink);
  /// `size_mm`: radius.
  void mark(const Eigen::Vector2d& at, Mark mark, double size_mm, const Ink& ink);
  /// `at`: left end of the base line.
  void text(const Eigen::Vector2d& at, const std::string& text, double size_mm, const Ink& ink);
  /// Breaks a text into lines of a width; `at`: left end of the first base line. Returns y of the
  /// base line after the last one.
  double paragraph(const Eigen::Vector2d& at, double width_mm, const std::string& text,
                   double size_mm, const Ink& ink);

  /// Draws only within a box until `end_clip`.
  void clip(const Eigen::AlignedBox2d& box);
  void end_clip();

  /// Ends the page; what follows is drawn on a new one of the same size.
  void next_page();

  /// Throws FileError if the file cannot be written.
  void finish();

 private:
  struct Cairo;
  std::filesystem::path path_;
  std::unique_ptr<Cairo> cairo_;
};

}  // namespace adit
