// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/config/config_file.hpp"

namespace adit {

/// A value that is read from a file that the unit wrote: by a JSON pointer (RFC 6901), or from the
/// last row of a table with a heading (CSV, or TSV by the name of the file).
struct ScoreDefinition {
  std::string name;     ///< column of the results
  std::string file;     ///< relative to {out}; may have placeholders
  std::string pointer;  ///< of JSON, "/mission/outcome"
  std::string column;   ///< of a table

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("file", file);
    v("pointer", pointer);
    v("column", column);
  }
};

/// A file that is written into {out} before a unit starts.
struct UnitFileDefinition {
  std::string name;  ///< relative to {out}
  std::string text;  ///< may have placeholders

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("text", text);
  }
};

/// A share of the units, with the bounds that are asked for.
struct RateDefinition {
  std::string name;
  std::string condition;    ///< SQL expression over the columns of the results
  std::string given;        ///< units that count; empty: all
  double min = 0.0;         ///< wanted
  double max = 1.0;         ///< wanted
  double stop_width = 0.0;  ///< the campaign stops at a narrower 95 % interval; 0: never

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("condition", condition);
    v("given", given);
    v("min", min, within(0.0, 1.0));
    v("max", max, within(0.0, 1.0));
    v("stop_width", stop_width, within(0.0, 1.0));
  }
};

/// A histogram of the page.
struct DistributionDefinition {
  std::string name;
  std::string value;  ///< SQL expression over the columns of the results

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("value", value);
  }
};

/// What a campaign runs and what it asks for: section `campaign` of its file. The section `matrix`
/// is a ParameterMatrix.
struct CampaignDefinition {
  std::string name;
  std::string command;  ///< template with {placeholders}, in quotes as for a shell
  std::vector<UnitFileDefinition> files;
  std::string inputs;                   ///< files on which the results depend, as words of a shell
  std::vector<double> exit_codes{0.0};  ///< of a unit that has a result
  double time_max_s = 3600.0;           ///< wall time of a unit
  double memory_max_mb = 4000.0;        ///< resident sets of all processes of a unit
  int cores = 1;                        ///< of a unit
  std::string remove;                   ///< patterns of outputs that are not kept, likewise
  std::string report;                   ///< output to which the page links
  std::string worst;                    ///< SQL expression, largest for the worst unit
  std::vector<ScoreDefinition> scores;
  std::vector<RateDefinition> rates;
  std::vector<DistributionDefinition> distributions;

  template <class V>
  void visit(V& v) {
    v("name", name);
    v("command", command);
    v("files", files);
    v("inputs", inputs);
    v("exit_codes", exit_codes, within(0.0, 255.0));
    v("time_max_s", time_max_s, above(0.0));
    v("memory_max_mb", memory_max_mb, above(0.0));
    v("cores", cores, within(1.0, 1024.0));
    v("remove", remove);
    v("report", report);
    v("worst", worst);
    v("scores", scores);
    v("rates", rates);
    v("distributions", distributions);
  }

  /// Whether a rate may stop the campaign, so that units run in a shuffled order.
  [[nodiscard]] bool stops_early() const;
  [[nodiscard]] bool accepts(int exit_code) const;
};

/// Loads and checks the section `campaign`: names are SQL identifiers and unique, pointers are
/// valid. The name of a campaign without one is that of the file. `other_sections`: those that the
/// file may have beside it. Throws ConfigError.
CampaignDefinition load_campaign(const ConfigFile& file,
                                 const std::vector<std::string>& other_sections = {"matrix"});

/// Whether the name can be a placeholder and a column: letters, digits and _, lower case, no digit
/// first.
bool is_column_name(const std::string& name);

}  // namespace adit
