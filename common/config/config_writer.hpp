// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/config/config_loader.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// Visitor that writes parameters as YAML that loads again as the same values, with the bounds of
/// each number as a comment.
class ConfigWriter {
 public:
  explicit ConfigWriter(std::string_view section);

  void operator()(std::string_view key, const bool& value);
  void operator()(std::string_view key, const int& value, const Bounds& bounds = {});
  void operator()(std::string_view key, const double& value, const Bounds& bounds = {});
  void operator()(std::string_view key, const std::string& value);
  void operator()(std::string_view key, const std::string& value, const OneOf& allowed);
  void operator()(std::string_view key, const std::vector<double>& values,
                  const Bounds& bounds = {});
  void operator()(std::string_view key, Pose2& pose);

  template <class Params>
  requires requires(Params& params, ConfigWriter& writer) { params.visit(writer); }
  void operator()(std::string_view key, Params& nested) {
    open(key);
    nested.visit(*this);
    --depth_;
  }

  template <class Params>
  requires requires(Params& params, ConfigWriter& writer) { params.visit(writer); }
  void operator()(std::string_view key, std::vector<Params>& list) {
    if (list.empty()) return line(key, "[]", {});
    open(key);
    for (Params& params : list) {
      begin_item();
      params.visit(*this);
      end_item();
    }
    --depth_;
  }

  /// Writes shared parameters as a section of their own, after that of the stage.
  template <class Params>
  void shared(std::string_view section, Params& params) {
    ConfigWriter writer(section);
    params.visit(writer);
    shared_ += writer.text();
  }

  [[nodiscard]] std::string text() const { return text_ + shared_; }

 private:
  void open(std::string_view key);
  void begin_item();
  void end_item();
  [[nodiscard]] std::string indent();
  void line(std::string_view key, const std::string& value, const Bounds& bounds);

  std::string text_;
  std::string shared_;
  std::size_t depth_ = 0;
  bool at_item_ = false;  // the next line begins a list item
};

}  // namespace adit
