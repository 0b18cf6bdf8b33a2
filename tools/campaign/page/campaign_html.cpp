// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/page/campaign_html.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/bus/node/version.hpp"
#include "common/config/number_text.hpp"
#include "tools/campaign/page/campaign_svg.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

constexpr int kWorstUnits = 10;
constexpr std::size_t kChangedMax = 50;

std::string verdict_text(const Rate& rate) {
  switch (rate.verdict()) {
    case RateVerdict::kNotAsked:
      return "";
    case RateVerdict::kNotCounted:
      return "no unit counts";
    case RateVerdict::kShown:
      return "met; the interval too";
    case RateVerdict::kMet:
      return "met; the interval is not within";
    case RateVerdict::kNotMet:
      return "<b>not met</b>";
  }
  return "";
}

std::string wanted_text(const RateDefinition& rate) {
  std::string text;
  if (rate.min > 0.0) text += fmt::format("≥ {} %", number_text(100.0 * rate.min));
  if (rate.max < 1.0)
    text += fmt::format("{}≤ {} %", text.empty() ? "" : ", ", number_text(100.0 * rate.max));
  return text;
}

std::string interval_text(const ShareInterval& interval) {
  return fmt::format("{} to {} %", fixed(100.0 * interval.lower, 1),
                     fixed(100.0 * interval.upper, 1));
}

std::string rates_table(const std::vector<Rate>& rates) {
  if (rates.empty()) return "";
  std::string rows;
  for (const Rate& rate : rates) {
    const RateDefinition& definition = rate.definition;
    const std::string given =
        definition.given.empty() ? "" : fmt::format(" of those with {}", definition.given);
    rows += fmt::format(
        R"(<tr class="{}"><th>{}<br><code>{}</code></th><td>{} of {}{}</td><td>{} %</td><td>{}</td>)"
        "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
        rate.verdict() == RateVerdict::kNotMet ? "bad" : "good", escaped(definition.name),
        escaped(definition.condition + given), rate.count(), rate.counts.total(),
        rate.counts.unknown > 0 ? fmt::format(", {} unknown", rate.counts.unknown) : "",
        fixed(100.0 * rate.share(), 1), interval_text(rate.interval()), interval_svg(rate),
        wanted_text(definition), verdict_text(rate));
  }
  return "<h2>Rates</h2>\n<table><tr><th>rate</th><th>units</th><th>share</th><th>95 % "
         "interval</th>"
         "<th>0 to 100 %</th><th>wanted</th><th></th></tr>\n" +
         rows +
         "</table>\n<p>A unit whose value is unknown counts against what is wanted. Intervals are "
         "those of Wilson.</p>\n";
}

std::string states_table(const std::vector<std::pair<std::string, int>>& states) {
  std::string rows;
  for (const auto& [state, count] : states)
    rows += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(state), count);
  return "<h2>How units ended</h2>\n<table>" + rows + "</table>\n";
}

std::string distributions(const std::vector<Histogram>& histograms) {
  if (histograms.empty()) return "";
  std::string figures;
  for (const Histogram& histogram : histograms) {
    const std::string without =
        histogram.without > 0 ? fmt::format("; {} without", histogram.without) : "";
    figures += fmt::format(
        "<figure>{}<figcaption><b>{}</b>, {} units{}<br>median {}, 95 % below "
        "{}</figcaption></figure>\n",
        histogram_svg(histogram), escaped(histogram.name), histogram.values, without,
        compact_number(histogram.median), compact_number(histogram.percentile95));
  }
  return "<h2>Distributions</h2>\n" + figures;
}

/// A link if the file exists.
std::string link(const CampaignFolder& folder, const std::filesystem::path& file,
                 const std::string& text) {
  std::error_code error;
  const bool is_there = std::filesystem::file_size(file, error) > 0 && !error;
  if (!is_there) return "";
  return fmt::format(R"(<a href="{}">{}</a> )",
                     escaped(file.lexically_relative(folder.path).generic_string()), escaped(text));
}

std::string worst_table(const CampaignPage& page, const CampaignFolder& folder) {
  if (page.worst.empty()) return "";
  std::string rows;
  for (const WorstUnit& unit : page.worst) {
    std::string links;
    if (!page.report.empty()) links += link(folder, folder.output(unit.id) / page.report, "report");
    links += link(folder, folder.output_log(unit.id), "output");
    rows += fmt::format(
        "<tr><td>{}</td><td><code>{}</code></td><td>{}{}</td><td>{}</td><td>{}</td><td>{}</td></"
        "tr>\n"
        "<tr class=\"command\"><td></td><td colspan=\"5\"><code>{}{}</code></td></tr>\n",
        unit.number, escaped(unit.parameters), escaped(unit.state),
        unit.reason.empty() ? "" : ": " + escaped(unit.reason), escaped(unit.violated),
        escaped(unit.value), links, unit.scores == "{}" ? "" : escaped(unit.scores) + "<br>",
        escaped(unit.command));
  }
  return fmt::format(
      "<h2>The {} worst units</h2>\n<table><tr><th>unit</th><th>parameters</th><th>end</th>"
      "<th>against the bounds of</th><th>{}</th><th></th></tr>\n{}</table>\n",
      page.worst.size(), escaped(page.worst_by), rows);
}

std::string p_text(double p) { return p < 0.001 ? "&lt; 0.001" : fixed(p, 3); }

std::string changed_list(const RateComparison& comparison, const CampaignFolder& folder) {
  std::string items;
  for (std::size_t i = 0; i < comparison.changed.size() && i < kChangedMax; ++i) {
    const ChangedUnit& unit = comparison.changed[i];
    items += fmt::format("<li>unit {} <code>{}</code>: {} {}</li>\n", unit.number,
                         escaped(unit.parameters), unit.is_now ? "now" : "no longer",
                         link(folder, folder.output_log(unit.id), "output"));
  }
  if (items.empty()) return "";
  const std::size_t more =
      comparison.changed.size() - std::min(comparison.changed.size(), kChangedMax);
  return fmt::format("<h3>{}: units that changed</h3>\n<ul>\n{}</ul>\n{}",
                     escaped(comparison.now.definition.name), items,
                     more > 0 ? fmt::format("<p>and {} more</p>\n", more) : "");
}

std::string comparison_section(const CampaignPage& page, const CampaignFolder& folder) {
  if (page.compared_with.empty()) return "";
  std::string rows;
  std::string lists;
  for (const RateComparison& comparison : page.comparisons) {
    rows += fmt::format(
        "<tr><th>{}</th><td>{} of {}</td><td>{} of {}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        escaped(comparison.now.definition.name), comparison.earlier.count(),
        comparison.earlier.counts.total(), comparison.now.count(), comparison.now.counts.total(),
        comparison.pairs, comparison.only_earlier, comparison.only_now,
        p_text(comparison.mcnemar_p), p_text(comparison.fisher_p));
    lists += changed_list(comparison, folder);
  }
  return fmt::format(
      "<h2>Compared with {}</h2>\n<table><tr><th>rate</th><th>then</th><th>now</th><th>pairs</th>"
      "<th>only then</th><th>only now</th><th>p, pairs (McNemar)</th><th>p, all "
      "(Fisher)</th></tr>\n"
      "{}</table>\n<p>Pairs are units of the same parameters. p: the probability of a difference "
      "at least as large if nothing changed; exact, two-sided.</p>\n{}",
      escaped(page.compared_with), rows, lists);
}

}  // namespace

CampaignPage describe_campaign(const CampaignDefinition& definition, Database& database) {
  CampaignPage page;
  page.name = definition.name;
  page.report = definition.report;
  page.worst_by = definition.worst;
  SqlStatement sums =
      database.prepare("SELECT count(*), count(state), coalesce(sum(wall_s), 0) FROM campaign");
  sums.step();
  page.units = static_cast<int>(sums.integer(0));
  page.with_result = static_cast<int>(sums.integer(1));
  page.wall_s = sums.number(2);
  SqlStatement states = database.prepare(
      "SELECT coalesce(state, 'no result yet'), count(*) FROM campaign GROUP BY state "
      "ORDER BY count(*) DESC, state");
  while (states.step())
    page.states.emplace_back(states.text(0), static_cast<int>(states.integer(1)));
  page.rates = measure_rates(definition, database);
  for (const DistributionDefinition& distribution : definition.distributions)
    page.histograms.push_back(measure_histogram(distribution, database));
  page.worst = worst_units(definition, database, kWorstUnits);
  return page;
}

std::string campaign_html(const CampaignPage& page, const CampaignFolder& folder) {
  const std::string suffices =
      page.stopped_after ? "; these suffice for the rates that are asked for" : "";
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<h1>{}</h1>\n"
             "<p>{} of {} units have a result{}. They took {} together. adit {}.</p>\n",
             escaped(page.name), campaign_styles().front().text, escaped(page.name),
             page.with_result, page.units, suffices, duration_text(page.wall_s), version()) +
         rates_table(page.rates) + states_table(page.states) + distributions(page.histograms) +
         worst_table(page, folder) + comparison_section(page, folder) +
         fmt::format("<h2>Campaign</h2>\n<pre>{}</pre>\n</body>\n</html>\n",
                     escaped(page.file_text));
}

}  // namespace adit
