// Things that only one of two scenes has: some of them were only renamed.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "app/check_input.h"

namespace lucarne {

template <class T>
class Unpaired {
 public:
  /// One of the two is null.
  void add(const T* gone, const T* fresh) {
    if (gone != nullptr) gone_.push_back(gone);
    if (fresh != nullptr) fresh_.push_back(fresh);
  }

  /// "material 'oak' is gone", "material 'ash' is new": but nothing of two that are `same` but for their names.
  template <class Same>
  void tell(const std::string& what, const Same& same, std::vector<std::string>& list) {
    for (const T*& gone : gone_) {
      const auto at = std::find_if(fresh_.begin(), fresh_.end(), [&](const T* f) { return same(*gone, *f); });
      if (at == fresh_.end()) continue;
      fresh_.erase(at);
      gone = nullptr;
    }
    for (const T* gone : gone_)
      if (gone != nullptr) list.push_back(what + " " + quotedName(gone->name) + " is gone");
    for (const T* fresh : fresh_) list.push_back(what + " " + quotedName(fresh->name) + " is new");
  }

 private:
  std::vector<const T*> gone_, fresh_;
};

}  // namespace lucarne
