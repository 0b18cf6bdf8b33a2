// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/page/campaign_svg.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tools/report/text_format.hpp"

namespace adit {
namespace {

constexpr double kIntervalWidth = 200.0;
constexpr double kIntervalHeight = 16.0;
constexpr double kHistogramWidth = 280.0;
constexpr double kHistogramHeight = 90.0;
constexpr double kAxisHeight = 16.0;
constexpr double kMargin = 4.0;

std::string rectangle(const char* css_class, double x, double y, double width, double height) {
  return fmt::format(R"(<rect class="{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)",
                     css_class, x, y, width, height);
}

std::string svg(double width, double height, const std::string& parts) {
  return fmt::format(
      R"(<svg width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}">{2}</svg>)", width,
      height, parts);
}

std::string axis_text(double x, const char* anchor, double value) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x,
                     kHistogramHeight + kAxisHeight - kMargin, anchor, compact_number(value));
}

}  // namespace

std::string compact_number(double number) { return escaped(fmt::format("{:.4g}", number)); }

std::string interval_svg(const Rate& rate) {
  const auto x = [](double share) { return kMargin + share * (kIntervalWidth - 2.0 * kMargin); };
  const auto part = [&](const char* css_class, double from, double to, double height) {
    return rectangle(css_class, x(from), 0.5 * (kIntervalHeight - height), x(to) - x(from), height);
  };
  const ShareInterval interval = rate.interval();
  const bool asked = rate.verdict() != RateVerdict::kNotAsked;
  return svg(
      kIntervalWidth, kIntervalHeight,
      part("scale", 0.0, 1.0, 1.0) +
          (asked ? part("wanted", rate.definition.min, rate.definition.max, kIntervalHeight) : "") +
          part("interval", interval.lower, interval.upper, 5.0) +
          fmt::format(R"(<circle class="share" cx="{:.1f}" cy="{:.1f}" r="3.5"/>)", x(rate.share()),
                      0.5 * kIntervalHeight));
}

std::string histogram_svg(const Histogram& histogram) {
  if (histogram.counts.empty()) return "";
  const double highest = *std::ranges::max_element(histogram.counts);
  const double width =
      (kHistogramWidth - 2.0 * kMargin) / static_cast<double>(histogram.counts.size());
  std::string parts;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double height = histogram.counts[i] / highest * (kHistogramHeight - kMargin);
    parts += rectangle("bar", kMargin + static_cast<double>(i) * width, kHistogramHeight - height,
                       std::max(width - 1.0, 1.0), height);
  }
  parts += rectangle("scale", 0.0, kHistogramHeight, kHistogramWidth, 1.0);
  parts += axis_text(kMargin, "start", histogram.min);
  if (histogram.max > histogram.min)
    parts += axis_text(kHistogramWidth - kMargin, "end", histogram.max);
  return svg(kHistogramWidth, kHistogramHeight + kAxisHeight, parts);
}

}  // namespace adit
