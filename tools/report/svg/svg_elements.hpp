// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

namespace adit {

// Parts of a drawing, with a class of CSS each.

/// Nothing where there are no parts.
std::string svg_group(const char* css_class, const std::string& parts);
/// Nothing where there is no line.
std::string svg_path_element(const std::string& css_class, const std::string& d);
/// `text` is for who points at it.
std::string svg_circle(const std::string& css_class, const Eigen::Vector2d& at, double radius,
                       const std::string& text = "");
/// Of a line: from one place to another.
std::string line_data(const Eigen::Vector2d& a, const Eigen::Vector2d& b);
/// "12.3,45.6" of a place.
std::string svg_point(const Eigen::Vector2d& p);

}  // namespace adit
