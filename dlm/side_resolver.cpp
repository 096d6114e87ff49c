#include "dlm/side_resolver.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "base/error.h"

namespace lucarne {

namespace {

constexpr double kLeastWeight = -2;

/// Moments of the weights under a kernel.
struct PlaneSums {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  Vec2d least{}, most{};  // offsets that weigh anything lie between these

  void add(double weight, int dx, int dy) {
    const double u = dx, v = dy;
    x += weight * u, y += weight * v;
    xx += weight * u * u, xy += weight * u * v, yy += weight * v * v;
    least = {std::min(least.x, u), std::min(least.y, v)};
    most = {std::max(most.x, u), std::max(most.y, v)};
  }

  /// One axis where the offsets lie on a line through the centre, none where they lie at it.
  Vec2d solve() const {
    constexpr double kSingular = 1e-9;
    const double determinant = xx * yy - xy * xy;
    if (determinant > kSingular * xx * yy) return {(xy * y - yy * x) / determinant, (xy * x - xx * y) / determinant};
    const double along = xx + yy;  // the line's direction is that of (xx, xy), or of (xy, yy)
    return along > 0 ? Vec2d{-x / along, -y / along} : Vec2d{};
  }

  Vec2d lean() const {
    const Vec2d a = solve();
    const double lowest = std::min(a.x * least.x, a.x * most.x) + std::min(a.y * least.y, a.y * most.y);
    return lowest < kLeastWeight - 1 ? a * ((kLeastWeight - 1) / lowest) : a;
  }
};

}  // namespace

template <class F>
void SideResolver::forNeighbours(int x, int y, F&& f) const {
  const int r = kernel_.radius;
  const auto here = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  const Vec2d a = lean_.empty() ? Vec2d{} : lean_[here];
  for (int v = std::max(0, y - r); v <= std::min(height_ - 1, y + r); ++v) {
    for (int u = std::max(0, x - r); u <= std::min(width_ - 1, x + r); ++u) {
      const auto n = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
      if (!contacts_.empty() && (!(contacts_.share(n) > 0) || contacts_.separated(here, u - x, v - y))) continue;
      f(n, kernel_(u - x) * kernel_(v - y) * (1 + a.x * (u - x) + a.y * (v - y)));
    }
  }
}

SideResolver::SideResolver(int width, int height, std::span<const double> area, const Kernel& kernel,
                           const SideContacts& contacts)
    : width_(width), height_(height), kernel_(kernel), contacts_(contacts) {
  LUCARNE_CHECK_EQ(area.size(), static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  inverseArea_.resize(area.size());
  if (kernel.linear) lean(area);
  std::size_t t = 0;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x, ++t) {
      double sum = 0;
      forNeighbours(x, y, [&](std::size_t n, double k) { sum += k * area[n] * contacts.share(n); });
      inverseArea_[t] = sum > 0 && !contacts.hidden(t) ? 1 / sum : 0;
    }
  }
  findSources();
}

/// The a of every texel.
void SideResolver::lean(std::span<const double> area) {
  std::vector<Vec2d> leans(area.size());
  std::size_t t = 0;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x, ++t) {
      PlaneSums sums;
      forNeighbours(x, y, [&](std::size_t n, double k) {
        const double weight = k * area[n] * contacts_.share(n);
        if (weight > 0) sums.add(weight, static_cast<int>(n % static_cast<std::size_t>(width_)) - x, static_cast<int>(n / static_cast<std::size_t>(width_)) - y);
      });
      leans[t] = sums.lean();
    }
  }
  lean_ = std::move(leans);
}

/// Breadth first from the texels with a value, so that each of the others finds a nearest one: without crossing a
/// contact where that is possible.
void SideResolver::findSources() {
  source_.assign(inverseArea_.size(), kNone);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t t = 0; t < source_.size(); ++t) {
    if (inverseArea_[t] <= 0) continue;
    source_[t] = t;
    queue.push_back(t);
  }
  spreadSources(queue, false);
  if (!contacts_.empty()) spreadSources(queue, true);
}

void SideResolver::spreadSources(std::vector<std::uint32_t>& queue, bool acrossContacts) {
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const int x = static_cast<int>(queue[head]) % width_, y = static_cast<int>(queue[head]) / width_;
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_) continue;
      const auto n = static_cast<std::uint32_t>((y + dy) * width_ + x + dx);
      if (source_[n] != kNone || (!acrossContacts && contacts_.separated(queue[head], dx, dy))) continue;
      source_[n] = source_[queue[head]];
      queue.push_back(n);
    }
  }
}

void SideResolver::restrictTo(std::span<const std::uint8_t> levels, std::uint8_t level) {
  levels_ = levels;
  level_ = level;
}

template <class T>
void SideResolver::spread(std::vector<T>& values) const {
  for (std::size_t t = 0; t < values.size(); ++t)
    if (source_[t] != t && source_[t] != kNone) values[t] = values[source_[t]];
}

template <class T, class F>
std::vector<T> SideResolver::filter(int power, F&& term) const {
  std::vector<T> values(inverseArea_.size());
  std::size_t t = 0;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x, ++t) {
      if (inverseArea_[t] <= 0 || skips(t)) continue;
      T sum{};
      forNeighbours(x, y, [&](std::size_t n, double k) { sum += term(n, k); });
      for (int i = 0; i < power; ++i) sum = sum * inverseArea_[t];
      values[t] = sum;
    }
  }
  if (levels_.empty()) spread(values);
  return values;
}

namespace {

Rgbd unitsAt(std::span<const std::int64_t> units, std::size_t n) {
  const std::int64_t* p = units.data() + 3 * n;
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

double positivePart(double v) { return std::max(v, 0.0); }
Rgbd positivePart(const Rgbd& v) { return {positivePart(v.x), positivePart(v.y), positivePart(v.z)}; }

}  // namespace

template <class T>
std::vector<T> SideResolver::notNegative(std::vector<T> values) const {
  if (lean_.empty()) return values;
  for (T& v : values) v = positivePart(v);
  return values;
}

std::vector<Rgbd> SideResolver::filterRgb(std::span<const std::int64_t> units) const {
  return notNegative(filter<Rgbd>(1, [&](std::size_t n, double k) { return unitsAt(units, n) * k; }));
}

std::vector<Rgbd> SideResolver::filterMeans(std::span<const std::int64_t> means, std::span<const double> area) const {
  return notNegative(filter<Rgbd>(1, [&](std::size_t n, double k) { return unitsAt(means, n) * (k * area[n]); }));
}

std::vector<double> SideResolver::filterValues(std::span<const double> values) const {
  return notNegative(filterDifferences(values));
}

std::vector<double> SideResolver::filterDifferences(std::span<const double> values) const {
  return filter<double>(1, [&](std::size_t n, double k) { return k * values[n]; });
}

std::vector<double> SideResolver::sumUnderKernel(std::span<const double> values) const {
  return filter<double>(0, [&](std::size_t n, double k) { return k > 0 ? values[n] : 0.0; });
}

std::vector<double> SideResolver::filterSquares(std::span<const double> values) const {
  return filter<double>(2, [&](std::size_t n, double k) { return k * k * values[n]; });
}

}  // namespace lucarne
