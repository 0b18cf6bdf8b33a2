// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The table of keys of docs/howto/your_robot.md against the declarations.
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/bounds.hpp"
#include "common/config/config_loader.hpp"
#include "common/config/number_text.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"

namespace adit {
namespace {

/// Visitor that lists keys as the first three columns of the table: name, default, values.
class KeyRows {
 public:
  explicit KeyRows(std::string section) : path_(std::move(section)) {}

  void operator()(std::string_view key, int& value, const Bounds& bounds = {}) {
    add(key, fmt::format("{}", value), bounds.is_unbounded() ? "" : bounds.text());
  }
  void operator()(std::string_view key, double& value, const Bounds& bounds = {}) {
    add(key, number_text(value), bounds.is_unbounded() ? "" : bounds.text());
  }
  void operator()(std::string_view key, bool& value) {
    add(key, fmt::format("{}", value), "true, false");
  }
  void operator()(std::string_view key, std::string& value, const OneOf& allowed) {
    add(key, value, allowed.text());
  }
  void operator()(std::string_view key, std::vector<FootprintCorner>&) { add(key, "[]", ""); }
  void operator()(std::string_view key, Pose2& pose) {
    PoseKeys keys{pose};
    (*this)(key, keys);
  }
  template <class Params>
  requires requires(Params& params, KeyRows& rows) { params.visit(rows); }
  void operator()(std::string_view key, Params& nested) {
    if (key == "rear") return;  // the keys of the front laser
    const std::string outer = path_;
    path_ += fmt::format(".{}", key);
    nested.visit(*this);
    path_ = outer;
  }

  [[nodiscard]] const std::vector<std::string>& rows() const { return rows_; }

 private:
  void add(std::string_view key, const std::string& value, const std::string& values) {
    rows_.push_back(fmt::format("| `{}.{}` | {} | {} |", path_, key, value, values));
  }

  std::string path_;
  std::vector<std::string> rows_;
};

template <class Params>
std::vector<std::string> rows_of(const char* section) {
  Params params;
  KeyRows rows(section);
  params.visit(rows);
  return rows.rows();
}

TEST(YourRobot, ExplainsEveryKeyOfTheRobotWithItsDefaultAndBounds) {
  std::vector<std::string> declared = rows_of<Lasers>(Lasers::kSection);
  for (const std::string& row : rows_of<Vehicle>(Vehicle::kSection)) declared.push_back(row);

  std::ifstream page(std::filesystem::path(ADIT_SOURCE_DIR) / "docs/howto/your_robot.md");
  std::vector<std::string> documented;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `lasers.") && !line.starts_with("| `vehicle.")) continue;
    std::size_t end = 0;
    for (int column = 0; column < 3; ++column) end = line.find('|', end + 1);
    documented.push_back(line.substr(0, end + 1));
    EXPECT_GT(line.size(), end + 10) << "no meaning: " << line;
  }
  EXPECT_THAT(documented, testing::ElementsAreArray(declared));
}

}  // namespace
}  // namespace adit
