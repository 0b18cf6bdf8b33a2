// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_bytes.hpp"

#include <cstring>

namespace adit {
namespace {

void append(Bytes& bytes, const void* from, std::size_t n) {
  const std::size_t end = bytes.size();
  bytes.resize(end + n);
  if (n > 0) std::memcpy(bytes.data() + end, from, n);
}

/// The number of values, followed by the values.
template <class T>
void append_all(Bytes& bytes, const T* values, std::size_t n) {
  const auto size = static_cast<std::uint64_t>(n);
  append(bytes, &size, sizeof(size));
  append(bytes, values, n * sizeof(T));
}

class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

  template <class Container>
  Container take() {
    std::uint64_t n = 0;
    copy(&n, sizeof(n));
    Container values;
    values.resize(n);
    copy(values.data(), n * sizeof(typename Container::value_type));
    return values;
  }

 private:
  void copy(void* to, std::size_t n) {
    if (n > 0) std::memcpy(to, bytes_.data() + at_, n);
    at_ += n;
  }

  const Bytes& bytes_;
  std::size_t at_ = 0;
};

}  // namespace

Bytes to_bytes(const TriangleMesh& mesh) {
  Bytes bytes;
  append_all(bytes, mesh.vertices.data(), mesh.vertices.size());
  append_all(bytes, mesh.triangles.data(), mesh.triangles.size());
  append_all(bytes, mesh.triangle_parts.data(), mesh.triangle_parts.size());
  std::vector<std::uint8_t> kinds;
  for (const Part& part : mesh.parts) {
    kinds.push_back(static_cast<std::uint8_t>(part.kind));
    kinds.push_back(static_cast<std::uint8_t>(part.material));
  }
  append_all(bytes, kinds.data(), kinds.size());
  for (const Part& part : mesh.parts) append_all(bytes, part.name.data(), part.name.size());
  return bytes;
}

TriangleMesh mesh_from_bytes(const Bytes& bytes) {
  Reader reader(bytes);
  TriangleMesh mesh;
  mesh.vertices = reader.take<std::vector<Eigen::Vector3f>>();
  mesh.triangles = reader.take<std::vector<TriangleMesh::Triangle>>();
  mesh.triangle_parts = reader.take<std::vector<std::uint16_t>>();
  const auto kinds = reader.take<std::vector<std::uint8_t>>();
  for (std::size_t i = 0; i + 1 < kinds.size(); i += 2) {
    const auto kind = static_cast<PartKind>(kinds[i]);
    const auto material = static_cast<Material>(kinds[i + 1]);
    mesh.parts.push_back({kind, material, reader.take<std::string>()});
  }
  return mesh;
}

}  // namespace adit
