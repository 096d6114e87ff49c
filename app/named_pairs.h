// Things of two lists brought together by their names.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lucarne {

/// Calls visit(a, b) for the things of one name in both lists, the k-th of equal names with the k-th, in the order of
/// `first`; then visit(nullptr, b) for those that only `second` has. visit(a, nullptr) where `second` has none. T has a
/// member `name`.
template <class T, class Visit>
void forNamedPairs(const std::vector<const T*>& first, const std::vector<const T*>& second, const Visit& visit) {
  const auto keysOf = [](const std::vector<const T*>& list) {
    std::map<std::string, std::size_t> seen;
    std::vector<std::pair<std::string, std::size_t>> keys;
    for (const T* thing : list) keys.emplace_back(thing->name, seen[thing->name]++);
    return keys;
  };
  const auto keysA = keysOf(first), keysB = keysOf(second);
  std::map<std::pair<std::string, std::size_t>, const T*> inSecond;
  for (std::size_t i = 0; i < second.size(); ++i) inSecond[keysB[i]] = second[i];
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto at = inSecond.find(keysA[i]);
    visit(first[i], at == inSecond.end() ? nullptr : at->second);
    if (at != inSecond.end()) at->second = nullptr;
  }
  for (const auto& key : keysB)
    if (const T* left = inSecond[key]; left != nullptr) visit(nullptr, left);
}

}  // namespace lucarne
