#include "app/rate_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/html.h"
#include "base/units.h"

namespace lucarne {
namespace {

constexpr double kWidth = 640, kHeight = 200, kLeft = 8, kRight = 8, kTop = 22, kBottom = 24;

/// Photons a second between two times.
struct Step {
  double from, to, rate;
};

std::vector<Step> stepsOf(const nlohmann::json& curve) {
  std::vector<Step> steps;
  const auto seconds = curve.at("seconds").get<std::vector<double>>(),
             photons = curve.at("photons").get<std::vector<double>>();
  for (std::size_t i = 1; i < std::min(seconds.size(), photons.size()); ++i) {
    const double span = seconds[i] - seconds[i - 1];
    if (span > 0) steps.push_back({seconds[i - 1], seconds[i], (photons[i] - photons[i - 1]) / span});
  }
  return steps;
}

std::string at(double x, double y) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f,%.1f ", x, y);
  return text;
}

/// The least of 1, 2, 5, 10 … above a value.
double roundTop(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1., 2., 5.})
    if (value <= step * power) return step * power;
  return 10 * power;
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  char head[128];
  std::snprintf(head, sizeof head, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"%s\">", x, y, anchor);
  return head + escapeHtml(text) + "</text>";
}

}  // namespace

std::string ratePicture(const nlohmann::json& curve) {
  const std::vector<Step> steps = stepsOf(curve);
  if (steps.empty()) return {};
  double most = 0;
  for (const Step& s : steps) most = std::max(most, s.rate);
  if (!(most > 0) || !std::isfinite(most)) return {};
  const double top = roundTop(most), begin = steps.front().from, end = steps.back().to;
  const auto x = [&](double seconds) {
    return kLeft + (kWidth - kLeft - kRight) * (seconds - begin) / std::max(end - begin, 1e-9);
  };
  const auto y = [&](double rate) { return kHeight - kBottom - (kHeight - kTop - kBottom) * rate / top; };
  std::string line;
  for (const Step& s : steps) line += at(x(s.from), y(s.rate)) + at(x(s.to), y(s.rate));
  const std::string ground = at(kWidth - kRight, kHeight - kBottom), corner = at(kLeft, kHeight - kBottom);
  return "<svg viewBox=\"0 0 640 200\" role=\"img\" aria-label=\"photons per second over the time of the bake\">"
         "<polygon class=\"under\" points=\"" +
         corner + line + ground +
         "\"/>"
         "<polyline class=\"axis\" points=\"" +
         corner + ground +
         "\"/>"
         "<polyline class=\"axis faint\" points=\"" +
         at(kLeft, kTop) + at(kWidth - kRight, kTop) +
         "\"/>"
         "<polyline class=\"rate\" points=\"" +
         line + "\"/>" + label(kLeft, kTop - 7, "start", formatRate(top, "photons")) +
         label(kLeft, kHeight - 7, "start", formatDuration(begin)) +
         label(kWidth - kRight, kHeight - 7, "end", formatDuration(end)) + "</svg>";
}

}  // namespace lucarne
