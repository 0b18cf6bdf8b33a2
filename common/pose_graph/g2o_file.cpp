// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/g2o_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

#include "common/config/number_text.hpp"
#include "common/files/file_utils.hpp"
#include "common/files/new_file.hpp"
#include "common/geometry/symmetric_eigen.hpp"
#include "common/pose_graph/optimize.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr double kNegativeMax = 1e-9;  // relative to the largest eigenvalue: rounding of the digits

struct CloseGz {
  void operator()(gzFile_s* file) const { gzclose(file); }
};
using GzFile = std::unique_ptr<gzFile_s, CloseGz>;

/// The tokens of one line.
class LineTokens {
 public:
  LineTokens(std::string_view line, const std::string& file, std::size_t number)
      : rest_(line.substr(0, line.find('#'))), file_(file), number_(number) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw G2oError(file_, number_, reason);
  }

  std::string_view next() {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    const std::string_view token = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(token.size());
    return token;
  }

  template <class Number>
  Number number(const char* what) {
    const std::string_view token = next();
    if (token.empty()) fail(fmt::format("the line ends before its {}", what));
    const std::string_view digits = token.front() == '+' ? token.substr(1) : token;
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !is_finite(value)) {
      fail(fmt::format("{} is not a valid {}", quote(token), what));
    }
    return value;
  }

  void expect_end() {
    const std::string_view token = next();
    if (!token.empty()) fail(fmt::format("{} after the last number", quote(token)));
  }

 private:
  static bool is_finite(long) { return true; }
  static bool is_finite(double value) { return std::isfinite(value); }

  std::string_view rest_;
  const std::string& file_;
  std::size_t number_;
};

/// A constraint between ids, with its line.
struct Edge {
  long from;
  long to;
  PoseConstraint constraint;
  std::size_t line;
};

/// Row and column of each of the six numbers in the information matrix.
using InformationOrder = std::array<std::array<int, 2>, 6>;
constexpr InformationOrder kG2oOrder{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
constexpr InformationOrder kToroOrder{{{0, 0}, {0, 1}, {1, 1}, {2, 2}, {0, 2}, {1, 2}}};

class Parser {
 public:
  explicit Parser(std::string file) : file_(std::move(file)) {}

  void parse_line(std::string_view line, std::size_t number) {
    LineTokens tokens(line, file_, number);
    const std::string_view tag = tokens.next();
    if (tag.empty()) return;
    if (tag == "VERTEX_SE2" || tag == "VERTEX2") {
      parse_vertex(tokens);
    } else if (tag == "EDGE_SE2") {
      parse_edge(tokens, kG2oOrder, number);
    } else if (tag == "EDGE2") {
      parse_edge(tokens, kToroOrder, number);
    } else if (tag == "FIX") {
      fixed_.emplace_back(tokens.number<long>("id"), number);
    } else {
      tokens.fail(fmt::format("unknown tag {}", quote(tag)));
    }
    tokens.expect_end();
  }

  [[nodiscard]] G2oGraph graph() const {
    G2oGraph result;
    const std::map<long, int> index = index_nodes(result);
    result.graph.constraints = constraints(index);
    if (vertices_.empty()) chain_odometry(result.graph);
    check_fixed(result.ids);
    return result;
  }

  [[nodiscard]] G2oRun run(const G2oGraph& before) const {
    std::map<long, int> index;
    for (std::size_t i = 0; i < before.ids.size(); ++i) {
      index.emplace_hint(index.end(), before.ids[i], static_cast<int>(i));
    }
    G2oRun result;
    const auto add = [&](long id) {
      if (!index.emplace(id, static_cast<int>(index.size())).second) return false;
      result.ids.push_back(id);
      return true;
    };
    for (const auto& [id, pose] : vertices_) {
      if (add(id)) continue;
      throw std::runtime_error(fmt::format("{}: vertex {} is one of the graph", file_, id));
    }
    if (vertices_.empty()) {
      for (const Edge& edge : edges_) {
        add(edge.from);
        add(edge.to);
      }
    }
    result.constraints = constraints(index);
    check_fixed(before.ids);
    return result;
  }

 private:
  [[nodiscard]] std::vector<PoseConstraint> constraints(const std::map<long, int>& index) const {
    std::vector<PoseConstraint> result;
    result.reserve(edges_.size());
    for (const Edge& edge : edges_) {
      result.push_back(edge.constraint);
      result.back().from = index_of(index, edge.from, edge.line);
      result.back().to = index_of(index, edge.to, edge.line);
    }
    return result;
  }

  static Pose2 parse_pose(LineTokens& tokens) {
    Pose2 pose;
    pose.x = tokens.number<double>("finite number x");
    pose.y = tokens.number<double>("finite number y");
    pose.theta = tokens.number<double>("finite number theta");
    return pose;
  }

  void parse_vertex(LineTokens& tokens) {
    const long id = tokens.number<long>("id");
    if (!vertices_.emplace(id, parse_pose(tokens)).second) {
      tokens.fail(fmt::format("vertex {} is defined twice", id));
    }
  }

  void parse_edge(LineTokens& tokens, const InformationOrder& order, std::size_t number) {
    Edge edge{};
    edge.from = tokens.number<long>("id");
    edge.to = tokens.number<long>("id");
    edge.line = number;
    if (edge.from == edge.to) tokens.fail(fmt::format("an edge from {} to itself", edge.to));
    edge.constraint.T_from_to = parse_pose(tokens);
    Eigen::Matrix3d& information = edge.constraint.information;
    for (const auto& [r, c] : order) {
      information(r, c) = information(c, r) = tokens.number<double>("finite number of information");
    }
    const Eigen::Vector3d eigenvalues = symmetric_eigen(information).values;
    if (!(eigenvalues.minCoeff() >= -kNegativeMax * eigenvalues.cwiseAbs().maxCoeff())) {
      tokens.fail("the information has the negative eigenvalue " +
                  number_text(eigenvalues.minCoeff()));
    }
    edges_.push_back(edge);
  }

  /// Fills in the nodes of the result and returns the index of each id.
  std::map<long, int> index_nodes(G2oGraph& result) const {
    std::map<long, Pose2> nodes = vertices_;
    if (vertices_.empty()) {
      for (const Edge& edge : edges_) {
        nodes.emplace(edge.from, Pose2{});
        nodes.emplace(edge.to, Pose2{});
      }
    }
    std::map<long, int> index;
    for (const auto& [id, pose] : nodes) {
      index.emplace_hint(index.end(), id, static_cast<int>(result.ids.size()));
      result.ids.push_back(id);
      result.graph.poses.push_back(pose);
    }
    return index;
  }

  [[nodiscard]] int index_of(const std::map<long, int>& index, long id, std::size_t line) const {
    const auto found = index.find(id);
    if (found == index.end()) throw G2oError(file_, line, fmt::format("no vertex {}", id));
    return found->second;
  }

  void check_fixed(const std::vector<long>& ids) const {
    for (const auto& [id, line] : fixed_) {
      if (!ids.empty() && id == ids.front()) continue;
      throw G2oError(file_, line, fmt::format("only the first pose can be fixed, not {}", id));
    }
  }

  std::string file_;
  std::map<long, Pose2> vertices_;
  std::vector<Edge> edges_;
  std::vector<std::pair<long, std::size_t>> fixed_;  // id, line
};

template <class... Texts>
void append(std::string& text, const Texts&... texts) {
  ((text += texts, text += ' '), ...);
  text.back() = '\n';
}

std::string text_of(const Pose2& pose) {
  return number_text(pose.x) + " " + number_text(pose.y) + " " + number_text(pose.theta);
}

/// In the order of g2o.
std::string text_of(const Eigen::Matrix3d& information) {
  std::string text;
  for (const auto& [row, column] : kG2oOrder) {
    if (!text.empty()) text += ' ';
    text += number_text(information(row, column));
  }
  return text;
}

std::string text_of(const G2oGraph& g) {
  const auto id = [&](int node) { return std::to_string(g.ids[static_cast<std::size_t>(node)]); };
  std::string text;
  for (std::size_t i = 0; i < g.graph.poses.size(); ++i) {
    append(text, "VERTEX_SE2", id(static_cast<int>(i)), text_of(g.graph.poses[i]));
  }
  for (const PoseConstraint& c : g.graph.constraints) {
    append(text, "EDGE_SE2", id(c.from), id(c.to), text_of(c.T_from_to), text_of(c.information));
  }
  return text;
}

bool write_gz(const std::string& text, const std::filesystem::path& path) {
  GzFile file(gzopen(path.c_str(), "wb"));
  if (!file) return false;
  const int written = gzwrite(file.get(), text.data(), static_cast<unsigned>(text.size()));
  return written == static_cast<int>(text.size()) && gzclose(file.release()) == Z_OK;
}

}  // namespace

namespace {

Parser parse(const std::filesystem::path& path) {
  const std::string text = read_gzip_file(path);
  Parser parser(path.string());
  std::string_view rest = text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    parser.parse_line(line, number);
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  }
  return parser;
}

}  // namespace

G2oGraph read_g2o(const std::filesystem::path& path) { return parse(path).graph(); }

G2oRun read_g2o_run(const std::filesystem::path& path, const G2oGraph& graph) {
  return parse(path).run(graph);
}

void write_g2o(const G2oGraph& graph, const std::filesystem::path& path) {
  const std::string text = text_of(graph);
  if (path.extension() != ".gz") return write_text_file(text, path);
  NewFile file(path);
  if (!write_gz(text, file.part())) throw std::runtime_error("cannot write " + path.string());
  file.publish();
}

}  // namespace adit
