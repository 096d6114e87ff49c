#include "distributed/index_set.h"

#include <algorithm>

#include "base/error.h"
#include "base/units.h"

namespace lucarne {

void IndexSet::add(IndexRange range) {
  if (range.begin >= range.end) return;
  auto next = std::upper_bound(ranges_.begin(), ranges_.end(), range.begin,
                               [](std::uint64_t begin, const IndexRange& r) { return begin < r.begin; });
  if (next != ranges_.end()) LUCARNE_CHECK_LE(range.end, next->begin);
  if (next != ranges_.begin()) LUCARNE_CHECK_LE(std::prev(next)->end, range.begin);
  const bool joinsNext = next != ranges_.end() && next->begin == range.end;
  const bool joinsLast = next != ranges_.begin() && std::prev(next)->end == range.begin;
  if (joinsLast && joinsNext) {
    std::prev(next)->end = next->end;
    ranges_.erase(next);
  } else if (joinsLast) {
    std::prev(next)->end = range.end;
  } else if (joinsNext) {
    next->begin = range.begin;
  } else {
    ranges_.insert(next, range);
  }
}

void IndexSet::add(const IndexSet& other) {
  for (const IndexRange& r : other.ranges_) add(r);
}

std::uint64_t IndexSet::count() const {
  std::uint64_t sum = 0;
  for (const IndexRange& r : ranges_) sum += r.size();
  return sum;
}

std::uint64_t IndexSet::countOdd() const {
  std::uint64_t sum = 0;
  for (const IndexRange& r : ranges_) sum += r.end / 2 - r.begin / 2;
  return sum;
}

bool IndexSet::contains(IndexRange range) const { return missing(range).empty(); }

IndexSet IndexSet::common(const IndexSet& other) const {
  IndexSet both;
  std::size_t i = 0, j = 0;
  while (i < ranges_.size() && j < other.ranges_.size()) {
    const IndexRange &a = ranges_[i], &b = other.ranges_[j];
    both.add({std::max(a.begin, b.begin), std::min(a.end, b.end)});
    (a.end < b.end ? i : j) += 1;
  }
  return both;
}

IndexSet IndexSet::missing(IndexRange range) const {
  IndexSet gaps;
  std::uint64_t at = range.begin;
  for (const IndexRange& r : ranges_) {
    if (r.end <= at) continue;
    if (r.begin >= range.end) break;
    gaps.add({at, r.begin});
    at = r.end;
  }
  gaps.add({at, range.end});
  return gaps;
}

bool operator==(const IndexSet& a, const IndexSet& b) {
  return std::equal(a.ranges_.begin(), a.ranges_.end(), b.ranges_.begin(), b.ranges_.end(),
                    [](const IndexRange& x, const IndexRange& y) { return x.begin == y.begin && x.end == y.end; });
}

IndexRange shareOf(std::uint64_t photons, std::uint64_t k, std::uint64_t n) {
  LUCARNE_CHECK_LE(std::uint64_t{1}, k);
  LUCARNE_CHECK_LE(k, n);
  __extension__ typedef unsigned __int128 Wide;  // holds any product of two numbers of 64 bits
  const auto cut = [&](std::uint64_t i) { return static_cast<std::uint64_t>(Wide{photons} * i / n); };
  return {cut(k - 1), cut(k)};
}

std::string toText(const IndexSet& set) {
  constexpr std::size_t kMost = 6;
  std::string text;
  const auto& ranges = set.ranges();
  for (std::size_t i = 0; i < std::min(ranges.size(), kMost); ++i) {
    text += (i == 0 ? "" : ", ") + formatExactCount(ranges[i].begin) + ".." + formatExactCount(ranges[i].end);
  }
  if (ranges.size() > kMost) text += " and " + std::to_string(ranges.size() - kMost) + " more ranges";
  return text.empty() ? "none" : text;
}

}  // namespace lucarne
