// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets for point cloud files, the input of `adit plan`.
#include <stdexcept>
#include <string>

#include "tests/fuzz/targets.hpp"
#include "tests/unit/tools/cloud/cloud_bytes.hpp"
#include "tools/cloud/cloud_file.hpp"

namespace adit::fuzz {
namespace {

using Reader = PointCloud (*)(std::span<const std::uint8_t>);

Target reader_target(const std::string& name, Reader read,
                     const std::vector<std::string>& samples) {
  std::vector<Bytes> bytes;
  for (const std::string& sample : samples) bytes.emplace_back(sample.begin(), sample.end());
  return {name, bytes, [read](std::span<const std::uint8_t> input) -> std::string_view {
            try {
              (void)read(input);
            } catch (const std::runtime_error&) {
              return "rejected";
            }
            return "";
          }};
}

}  // namespace

std::vector<Target> cloud_targets() {
  const test::Points points = test::some_points();
  const std::string lists =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int v\nelement vertex 1\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n2 0 1\n1 2 3\n";
  return {reader_target("ply", read_ply,
                        {test::ply<float>("ascii", "float", points),
                         test::ply<double>("binary_little_endian", "double", points),
                         test::ply<std::int16_t>("binary_big_endian", "short", points), lists}),
          reader_target(
              "pcd", read_pcd,
              {test::pcd<float>("ascii", 'F', points), test::pcd<float>("binary", 'F', points),
               test::pcd<double>("binary_compressed", 'F', points)}),
          reader_target("xyz", read_xyz, {test::as_text(points), "x,y,z\n1,2,3,4\n"})};
}

}  // namespace adit::fuzz
