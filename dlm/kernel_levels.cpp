#include "dlm/kernel_levels.h"

#include <algorithm>

#include "base/error.h"

namespace lucarne {
namespace {

constexpr int kWindow = 2;  // texels around one whose biases are taken together

/// Means over windows of (2·kWindow + 1)² texels, of those that have surface.
std::vector<double> windowMeans(int width, int height, const std::vector<double>& values,
                                const std::vector<bool>& hasSurface) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  const auto pass = [&](const std::vector<double>& from, std::size_t step, std::size_t along, std::size_t lines,
                        std::size_t lineStep) {
    std::vector<double> to(from.size());
    for (std::size_t line = 0; line < lines; ++line)
      for (std::size_t i = 0; i < along; ++i) {
        const std::size_t first = i < kWindow ? 0 : i - kWindow, last = std::min(along - 1, i + kWindow);
        double sum = 0;
        for (std::size_t k = first; k <= last; ++k) sum += from[line * lineStep + k * step];
        to[line * lineStep + i * step] = sum;
      }
    return to;
  };
  std::vector<double> sums(values.size()), counts(values.size());
  for (std::size_t t = 0; t < values.size(); ++t) {
    sums[t] = hasSurface[t] ? values[t] : 0;
    counts[t] = hasSurface[t] ? 1 : 0;
  }
  sums = pass(pass(sums, 1, w, h, w), w, h, w, 1);
  counts = pass(pass(counts, 1, w, h, w), w, h, w, 1);
  for (std::size_t t = 0; t < sums.size(); ++t) sums[t] = counts[t] > 0 ? sums[t] / counts[t] : 0;
  return sums;
}

/// (E_l − E_0)² less its own variance: V_0 + V_l less twice the covariance, which is V_0 times what the texel weighs in
/// the wider kernel.
std::vector<double> biasesOf(const LevelEstimate& finest, const LevelEstimate& level, const std::vector<double>& own) {
  std::vector<double> biases(level.value.size());
  for (std::size_t t = 0; t < biases.size(); ++t) {
    const double difference = level.value[t] - finest.value[t];
    biases[t] = difference * difference - (finest.variance[t] * (1 - 2 * own[t]) + level.variance[t]);
  }
  return biases;
}

}  // namespace

LevelChoice chooseLevels(int width, int height, const std::vector<LevelEstimate>& levels,
                         const std::vector<std::vector<double>>& own, const std::vector<bool>& hasSurface) {
  const std::size_t texels = hasSurface.size();
  LUCARNE_CHECK_EQ(texels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto outside = static_cast<std::uint8_t>(std::min<std::size_t>(1, levels.size() - 1));
  LevelChoice choice{std::vector<std::uint8_t>(texels, outside), std::vector<double>(texels, 0)};
  std::vector<double> least(texels);
  for (std::size_t t = 0; t < texels; ++t) {
    if (!hasSurface[t]) continue;
    choice.level[t] = 0;
    least[t] = levels[0].variance[t];
  }
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const std::vector<double> biases = windowMeans(width, height, biasesOf(levels[0], levels[l], own[l]), hasSurface);
    for (std::size_t t = 0; t < texels; ++t) {
      const double bias = std::max(0.0, biases[t]), error = bias + levels[l].variance[t];
      if (!hasSurface[t] || !(error < least[t])) continue;
      least[t] = error;
      choice.level[t] = static_cast<std::uint8_t>(l);
      choice.biasSquared[t] = bias;
    }
  }
  return choice;
}

LevelResolver::LevelResolver(int width, int height, std::span<const double> area, std::span<const Kernel> kernels,
                             const SideContacts& contacts) {
  resolvers_.reserve(kernels.size());
  for (const Kernel& kernel : kernels) resolvers_.emplace_back(width, height, area, kernel, contacts);
}

void LevelResolver::choose(std::vector<std::uint8_t> levelOfTexel) {
  levelOfTexel_ = std::move(levelOfTexel);
  for (std::size_t l = 0; l < resolvers_.size(); ++l)
    resolvers_[l].restrictTo(levelOfTexel_, static_cast<std::uint8_t>(l));
}

template <class F>
auto LevelResolver::mixed(F&& filter) const {
  auto values = filter(resolvers_.back());
  if (levelOfTexel_.empty()) return values;
  for (std::size_t l = 0; l + 1 < resolvers_.size(); ++l) {
    const auto others = filter(resolvers_[l]);
    for (std::size_t t = 0; t < values.size(); ++t)
      if (levelOfTexel_[t] == l) values[t] = others[t];
  }
  for (std::size_t t = 0; t < values.size(); ++t) {
    const std::uint32_t source = resolvers_[levelOfTexel_[t]].source(t);
    if (source != t && source != kNone) values[t] = values[source];
  }
  return values;
}

std::vector<Rgbd> LevelResolver::filterRgb(std::span<const std::int64_t> units) const {
  return mixed([&](const SideResolver& r) { return r.filterRgb(units); });
}
std::vector<double> LevelResolver::filterValues(std::span<const double> values) const {
  return mixed([&](const SideResolver& r) { return r.filterValues(values); });
}

std::vector<double> LevelResolver::filterDifferences(std::span<const double> values) const {
  return mixed([&](const SideResolver& r) { return r.filterDifferences(values); });
}
std::vector<double> LevelResolver::sumUnderKernel(std::span<const double> values) const {
  return mixed([&](const SideResolver& r) { return r.sumUnderKernel(values); });
}
std::vector<Rgbd> LevelResolver::filterMeans(std::span<const std::int64_t> means, std::span<const double> area) const {
  return mixed([&](const SideResolver& r) { return r.filterMeans(means, area); });
}
std::vector<double> LevelResolver::filterSquares(std::span<const double> values) const {
  return mixed([&](const SideResolver& r) { return r.filterSquares(values); });
}

}  // namespace lucarne
