// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <string>
#include <system_error>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace adit {
namespace {

constexpr std::uint8_t kDone = 0;
constexpr std::uint8_t kFailed = 1;

[[noreturn]] void fail(const char* call) {
  throw std::system_error(errno, std::generic_category(), call);
}

void write_all(int descriptor, const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(descriptor, bytes.data() + done, bytes.size() - done);
    if (n < 0) fail("write");
    done += static_cast<std::size_t>(n);
  }
}

Bytes read_all(int descriptor) {
  Bytes bytes;
  std::array<std::uint8_t, 65536> buffer{};
  while (true) {
    const ssize_t n = read(descriptor, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read");
    if (n == 0) return bytes;
    bytes.insert(bytes.end(), buffer.data(), buffer.data() + n);
  }
}

/// Sends kDone and the result, or kFailed and the error text.
Bytes outcome(const std::function<Bytes()>& work) try {
  Bytes bytes = work();
  bytes.insert(bytes.begin(), kDone);
  return bytes;
} catch (const std::exception& error) {
  const std::string text = error.what();
  Bytes bytes(text.begin(), text.end());
  bytes.insert(bytes.begin(), kFailed);
  return bytes;
}

/// Exits without the exit handlers of the parent.
[[noreturn]] void run_child(const std::function<Bytes()>& work, int seconds, int descriptor) {
  const rlimit limit{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds)};
  setrlimit(RLIMIT_CPU, &limit);
  try {
    write_all(descriptor, outcome(work));
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail("waitpid");
  }
  return status;
}

}  // namespace

Bytes run_in_child_process(const std::function<Bytes()>& work, int seconds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) fail("pipe");
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    close(ends[0]);
    run_child(work, seconds, ends[1]);
  }
  close(ends[1]);
  Bytes bytes = read_all(ends[0]);
  close(ends[0]);
  const int status = wait_for(child);
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    throw ChildProcessError("it takes too long to read");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty()) {
    throw ChildProcessError("its reader crashed");
  }
  const bool failed = bytes.front() == kFailed;
  bytes.erase(bytes.begin());
  if (failed) throw std::runtime_error(std::string(bytes.begin(), bytes.end()));
  return bytes;
}

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
